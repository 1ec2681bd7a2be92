#include "modules/hough_segmenter/cell_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace declutter {
namespace {

using Values = std::vector<float>;
using testing::Pointwise;

MATCHER_P(NearBy, tolerance, "") {
  return std::abs(std::get<0>(arg) - std::get<1>(arg)) <= tolerance;
}

// Cells around an arc, some of them without weight.
struct Cells {
  static constexpr size_t kNum = 75;  // no multiple of a block
  Values x = Values(kNum + kCellBlock), y = x, nx = x, ny = x, inverse_limit = x, weight = x;

  Cells() {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0, 0.002f);
    for (size_t i = 0; i < x.size(); ++i) {
      const float angle = -0.04f * static_cast<float>(i) + 0.2f;
      x[i] = 0.1f + 0.04f * std::cos(angle) + noise(random);
      y[i] = 0.7f + 0.04f * std::sin(angle) + noise(random);
      nx[i] = std::cos(angle + 50 * noise(random));
      ny[i] = std::sqrt(1 - nx[i] * nx[i]) * (std::sin(angle) < 0 ? -1.0f : 1.0f);
      inverse_limit[i] = 1 / (0.004f * 0.004f);
      weight[i] = i % 7 == 3 ? 0 : static_cast<float>(1 + i % 5);
    }
  }
  CellView view() const {
    return {x.data(), y.data(), nx.data(), ny.data(), inverse_limit.data(), weight.data(), kNum};
  }

  float Agreement(size_t i, float distance, float cosine, float min_cos) const {
    if (weight[i] == 0) return 0;
    return std::max(0.0f, 1 - distance * distance * inverse_limit[i]) *
           std::max(0.0f, cosine - min_cos) / (1 - min_cos);
  }
  Values Expected(const LineShape& line, float min_cos) const {
    Values expected;
    for (size_t i = 0; i < kNum; ++i) {
      expected.push_back(Agreement(i, line.nx * x[i] + line.ny * y[i] - line.rho,
                                   line.nx * nx[i] + line.ny * ny[i], min_cos));
    }
    return expected;
  }
  Values Expected(const CircleShape& circle, float min_cos) const {
    Values expected;
    for (size_t i = 0; i < kNum; ++i) {
      const float dx = x[i] - circle.cx, dy = y[i] - circle.cy;
      const float radial = std::hypot(dx, dy);
      expected.push_back(
          Agreement(i, radial - circle.r, (dx * nx[i] + dy * ny[i]) / radial, min_cos));
    }
    return expected;
  }
  float WeightedSum(const Values& values) const {
    double sum = 0;
    for (size_t i = 0; i < values.size(); ++i) sum += static_cast<double>(weight[i] * values[i]);
    return static_cast<float>(sum);
  }
};

constexpr float kMinCos = 0.9f;
constexpr LineShape kLine{0.6f, -0.8f, -0.467f};
constexpr CircleShape kCircle{0.1f, 0.7f, 0.041f};

template <typename Shape>
float SupportOf(const Cells& cells, const Shape& shape) {
  float support = 0;
  Supports(cells.view(), &shape, 1, kMinCos, &support);
  return support;
}

// Each kernel beside plain loops, with every instruction set that this processor has.
class CellKernels : public testing::TestWithParam<int64_t> {
 protected:
  CellKernels() {
    hwy::SetSupportedTargetsForTest(GetParam());
    hwy::GetChosenTarget().DeInit();
  }
  ~CellKernels() override {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }

  const Cells cells_;
};

std::vector<int64_t> Targets() {
  std::vector<int64_t> targets;
  for (int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    targets.push_back(rest & -rest);
  }
  return targets;
}

INSTANTIATE_TEST_SUITE_P(Targets, CellKernels, testing::ValuesIn(Targets()),
                         [](const auto& target) {
                           return std::string(hwy::TargetName(target.param));
                         });

template <typename Shape>
void ExpectAgreements(const Cells& cells, const Shape& shape) {
  const Values expected = cells.Expected(shape, kMinCos);
  const auto num_inliers =
      std::count_if(expected.begin(), expected.end(), [](float a) { return a > 0; });
  ASSERT_GT(num_inliers, 5);
  ASSERT_LT(num_inliers, 70);
  Values found(Cells::kNum + kCellBlock);
  Agreements(cells.view(), shape, kMinCos, found.data());
  found.resize(Cells::kNum);
  EXPECT_THAT(found, Pointwise(NearBy(1e-4f), expected));
}

TEST_P(CellKernels, AgreementsOfALineAndOfACircle) {
  ExpectAgreements(cells_, kLine);
  ExpectAgreements(cells_, kCircle);
}

TEST_P(CellKernels, SupportIsTheWeightedSumOfAgreements) {
  const float line = cells_.WeightedSum(cells_.Expected(kLine, kMinCos));
  // For a circle the distance is to first order.
  std::vector<float> agreements;
  for (size_t i = 0; i < Cells::kNum; ++i) {
    const float dx = cells_.x[i] - kCircle.cx, dy = cells_.y[i] - kCircle.cy;
    const float distance = (dx * dx + dy * dy - kCircle.r * kCircle.r) / (2 * kCircle.r);
    const float cosine = (dx * cells_.nx[i] + dy * cells_.ny[i]) / kCircle.r;
    agreements.push_back(cells_.Agreement(i, distance, cosine, kMinCos));
  }
  const float circle = cells_.WeightedSum(agreements);
  ASSERT_NEAR(circle, cells_.WeightedSum(cells_.Expected(kCircle, kMinCos)), 0.15f * circle);
  EXPECT_NEAR(SupportOf(cells_, kLine), line, 1e-3 * line);
  EXPECT_NEAR(SupportOf(cells_, kCircle), circle, 1e-3 * circle);
}

TEST_P(CellKernels, CopyMarkedElementsToAnotherPlaceAndInPlace) {
  const size_t stride = Cells::kNum + kCellBlock;
  Values from(2 * stride), marks(stride);
  Values expected[2];
  for (size_t i = 0; i < Cells::kNum; ++i) {
    marks[i] = i % 3 == 0 || i > 60 ? 0.5f : (i % 3 == 1 ? 0.0f : -1.0f);
    for (size_t field = 0; field < 2; ++field) {
      from[field * stride + i] = static_cast<float>(100 * field + i);
      if (marks[i] > 0) expected[field].push_back(from[field * stride + i]);
    }
  }
  marks[Cells::kNum] = 1;  // no element
  Values to(2 * stride);
  EXPECT_EQ(CopyMarked(marks.data(), Cells::kNum, 2, from.data(), stride, to.data(), stride),
            expected[0].size());
  EXPECT_EQ(CopyMarked(marks.data(), Cells::kNum, 2, from.data(), stride, from.data(), stride),
            expected[0].size());
  for (const Values* copy : {&to, &from}) {
    for (size_t field = 0; field < 2; ++field) {
      const auto begin = copy->begin() + static_cast<std::ptrdiff_t>(field * stride);
      EXPECT_EQ(Values(begin, begin + static_cast<std::ptrdiff_t>(expected[field].size())),
                expected[field]);
    }
  }
}

TEST_P(CellKernels, RangeAlsoOfFewValues) {
  for (const size_t num : {Cells::kNum, size_t{3}, size_t{1}}) {
    const auto end = cells_.x.begin() + static_cast<std::ptrdiff_t>(num);
    const Range range = RangeOf(cells_.x.data(), num);
    EXPECT_EQ(range.low, *std::min_element(cells_.x.begin(), end));
    EXPECT_EQ(range.high, *std::max_element(cells_.x.begin(), end));
  }
}

TEST_P(CellKernels, SumsOfWeights) {
  float sum = 0, products = 0, below = 0;
  for (size_t i = 0; i < Cells::kNum; ++i) {
    sum += cells_.weight[i];
    products += cells_.weight[i] * cells_.x[i];
    below += cells_.x[i] < 0.11f ? cells_.weight[i] : 0;
  }
  ASSERT_NE(below, sum);
  EXPECT_EQ(SumOf(cells_.weight.data(), Cells::kNum), sum);
  EXPECT_NEAR(SumOfProducts(cells_.weight.data(), cells_.x.data(), Cells::kNum), products,
              1e-5f * products);
  EXPECT_EQ(WeightBelow(cells_.x.data(), cells_.weight.data(), Cells::kNum, 0.11f), below);
}

TEST_P(CellKernels, SumsForLeastSquares) {
  PointSums points;
  CircleSums circle;
  for (size_t i = 0; i < Cells::kNum; ++i) {
    const float w = cells_.weight[i];
    const float qx = cells_.x[i] - 0.1f, qy = cells_.y[i] - 0.7f;
    points.w += w, points.x += w * qx, points.y += w * qy;
    points.xx += w * qx * qx, points.xy += w * qx * qy, points.yy += w * qy * qy;
    const float d = std::hypot(qx, qy), ux = qx / d, uy = qy / d, e = d - kCircle.r;
    circle.w += w, circle.x += w * ux, circle.y += w * uy;
    circle.xx += w * ux * ux, circle.xy += w * ux * uy, circle.yy += w * uy * uy;
    circle.e += w * e, circle.xe += w * ux * e, circle.ye += w * uy * e;
  }
  const PointSums found =
      SumPoints(cells_.x.data(), cells_.y.data(), cells_.weight.data(), Cells::kNum, 0.1f, 0.7f);
  EXPECT_THAT((Values{found.w, found.x, found.y, found.xx, found.xy, found.yy}),
              Pointwise(NearBy(1e-4f),
                        Values{points.w, points.x, points.y, points.xx, points.xy, points.yy}));
  const CircleSums fit =
      SumCircle(cells_.x.data(), cells_.y.data(), cells_.weight.data(), Cells::kNum, kCircle);
  EXPECT_THAT((Values{fit.w, fit.x, fit.y, fit.xx, fit.xy, fit.yy, fit.e, fit.xe, fit.ye}),
              Pointwise(NearBy(1e-3f), Values{circle.w, circle.x, circle.y, circle.xx, circle.xy,
                                              circle.yy, circle.e, circle.xe, circle.ye}));
}

TEST_P(CellKernels, PositionsDistancesAndAngles) {
  Values positions, distances, angles;
  for (size_t i = 0; i < Cells::kNum; ++i) {
    const float qx = cells_.x[i] - 0.1f, qy = cells_.y[i] - 0.7f;
    positions.push_back(0.6f * cells_.x[i] - 0.8f * cells_.y[i]);
    distances.push_back(std::hypot(qx, qy));
    angles.push_back(std::atan2(-0.28f * qy - 0.96f * qx, -0.28f * qx + 0.96f * qy));
  }
  ASSERT_LT(*std::min_element(angles.begin(), angles.end()), -2);
  ASSERT_GT(*std::max_element(angles.begin(), angles.end()), 1);
  Values found(Cells::kNum + kCellBlock);
  const auto expect = [&found](const Values& expected, float tolerance) {
    const Values values(found.begin(), found.begin() + Cells::kNum);
    EXPECT_THAT(values, Pointwise(NearBy(tolerance), expected));
  };
  PositionsAlong(cells_.x.data(), cells_.y.data(), Cells::kNum, 0.6f, -0.8f, found.data());
  expect(positions, 1e-6f);
  Distances(cells_.x.data(), cells_.y.data(), Cells::kNum, 0.1f, 0.7f, found.data());
  expect(distances, 1e-6f);
  Angles(cells_.x.data(), cells_.y.data(), Cells::kNum, 0.1f, 0.7f, -0.28f, 0.96f, found.data());
  expect(angles, 3e-5f);
}

TEST_P(CellKernels, RangeOfPositionsAlsoOfFewPoints) {
  for (const size_t num : {Cells::kNum, size_t{3}, size_t{1}}) {
    Values positions;
    for (size_t i = 0; i < num; ++i) positions.push_back(0.6f * cells_.x[i] - 0.8f * cells_.y[i]);
    const Range range = RangeAlong(cells_.x.data(), cells_.y.data(), num, 0.6f, -0.8f);
    EXPECT_NEAR(range.low, *std::min_element(positions.begin(), positions.end()), 1e-6f);
    EXPECT_NEAR(range.high, *std::max_element(positions.begin(), positions.end()), 1e-6f);
  }
}

TEST_P(CellKernels, CountPointsInsideACircle) {
  size_t num_inside = 0;
  for (size_t i = 0; i < Cells::kNum; ++i) {
    num_inside += std::hypot(cells_.x[i] - 0.1f, cells_.y[i] - 0.7f) < kCircle.r;
  }
  ASSERT_GT(num_inside, 0u);
  ASSERT_LT(num_inside, Cells::kNum);
  EXPECT_EQ(CountInside(cells_.x.data(), cells_.y.data(), Cells::kNum, kCircle), num_inside);
}

TEST_P(CellKernels, CountPointsOnAndInsideARing) {
  int num_on = 0, num_inside = 0;
  for (size_t i = 0; i < Cells::kNum; ++i) {
    const float distance = std::hypot(cells_.x[i] - 0.1f, cells_.y[i] - 0.7f) - kCircle.r;
    num_on += std::abs(distance) < 0.002f;
    num_inside += distance < -0.004f;
  }
  ASSERT_GT(num_on, 0);
  ASSERT_GT(num_inside, 0);
  const RingCount count =
      CountOnRing(cells_.x.data(), cells_.y.data(), Cells::kNum, kCircle, 0.002f);
  EXPECT_EQ(count.num_on, num_on);
  EXPECT_EQ(count.num_inside, num_inside);
}

// What the sums of one instruction set round to is what those of all others do.
TEST(CellKernelsOfAllTargets, GiveTheSameBits) {
  const Cells cells;
  std::vector<float> line, circle;
  for (const int64_t target : Targets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    line.push_back(SupportOf(cells, kLine));
    circle.push_back(
        SumCircle(cells.x.data(), cells.y.data(), cells.weight.data(), Cells::kNum, kCircle).xe);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  EXPECT_THAT(line, testing::Each(line[0]));
  EXPECT_THAT(circle, testing::Each(circle[0]));
}

}  // namespace
}  // namespace declutter
