#include "modules/plane_filter/pixel_kernels.h"

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

// Each kernel beside plain loops, with every instruction set that this processor has.
class PixelKernels : public testing::TestWithParam<int64_t> {
 protected:
  PixelKernels() {
    hwy::SetSupportedTargetsForTest(GetParam());
    hwy::GetChosenTarget().DeInit();
    std::mt19937 random(5);
    std::uniform_real_distribution<float> noise(-0.02f, 0.02f);
    for (size_t i = 0; i < x_.size(); ++i) x_[i] = 0.002f * static_cast<float>(i) - 0.1f;
    for (size_t i = 0; i < y_.size(); ++i) y_[i] = 0.002f * static_cast<float>(i) - 0.02f;
    for (size_t v = kMargin; v < kMargin + kHeight; ++v) {
      for (size_t u = kMargin; u < kMargin + kWidth; ++u) {
        if (random() % 5 > 0) values_[v * kStride + u] = 1.2f + noise(random);
      }
    }
  }

  ~PixelKernels() override {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }

  const float* Row(size_t v) const { return &values_[(v + kMargin) * kStride + kMargin]; }
  const float* x() const { return &x_[kMargin]; }
  float y(size_t v) const { return y_[v + kMargin]; }
  PointWindow Window(size_t v) const {
    return {Row(v), static_cast<ptrdiff_t>(kStride), x(), &y_[v + kMargin]};
  }

  // Sorted distances from a point to the others in its window, over its depth.
  std::vector<float> Distances(size_t v, size_t u, int half) const {
    std::vector<float> distances;
    const float* center = Row(v) + u;
    const float depth = 1 / *center;
    for (int dv = -half; dv <= half; ++dv) {
      for (int du = -half; du <= half; ++du) {
        const float other = center[dv * static_cast<ptrdiff_t>(kStride) + du];
        if (other <= 0 || (du == 0 && dv == 0)) continue;
        const float z = 1 / other;
        const float dx = x()[static_cast<ptrdiff_t>(u) + du] * z - x()[u] * depth;
        const float dy = y_[v + kMargin + static_cast<size_t>(dv)] * z - y(v) * depth;
        distances.push_back(std::hypot(dx, dy, z - depth) / depth);
      }
    }
    std::sort(distances.begin(), distances.end());
    return distances;
  }

  static constexpr size_t kWidth = 43;  // no multiple of a vector's length
  static constexpr size_t kHeight = 9;
  static constexpr size_t kMargin = 7;
  static constexpr size_t kStride = kWidth + 2 * kMargin + kKernelPadding;

  std::vector<float> x_ = std::vector<float>(kStride);
  std::vector<float> y_ = std::vector<float>(kHeight + 2 * kMargin);
  std::vector<float> values_ = std::vector<float>(kStride * (kHeight + 2 * kMargin));
};

std::vector<int64_t> Targets() {
  std::vector<int64_t> targets;
  for (int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    targets.push_back(rest & -rest);
  }
  return targets;
}

INSTANTIATE_TEST_SUITE_P(Targets, PixelKernels, testing::ValuesIn(Targets()),
                         [](const auto& target) {
                           return std::string(hwy::TargetName(target.param));
                         });

TEST_P(PixelKernels, CountInliersOfAPlane) {
  std::vector<float> ys(kWidth, y(4));
  ys.resize(kWidth + kKernelPadding);
  std::vector<float> row(Row(4), Row(4) + kWidth + kKernelPadding);
  int expected = 0;
  for (size_t u = 0; u < kWidth; ++u) {
    const float plane = 0.1f * x()[u] + (0.2f * y(4) + 1.2f);
    expected += row[u] > 0 && std::abs(row[u] - plane) <= 0.01f;
  }
  ASSERT_GT(expected, 5);
  const auto count = [&](int max_uncounted) {
    return CountPlaneInliers(x(), ys.data(), row.data(), kWidth, 0.1f, 0.2f, 1.2f, 0.01f,
                             max_uncounted);
  };
  EXPECT_EQ(count(0), expected);
  EXPECT_EQ(count(expected - 1), expected);
  EXPECT_EQ(count(static_cast<int>(kWidth)), 0);
}

TEST_P(PixelKernels, MarkInliersOfAPlaneAlsoInAShortRow) {
  for (const size_t num : {kWidth, size_t{5}}) {
    std::vector<uint8_t> expected;
    for (size_t u = 0; u < num; ++u) {
      const float plane = 0.1f * x()[u] + 1.2f;
      expected.push_back(Row(3)[u] > 0 && std::abs(Row(3)[u] - plane) <= 0.01f);
    }
    std::vector<uint8_t> marked(num, 9);
    MarkPlaneInliers(x(), Row(3), num, 0.1f, 1.2f, 0.01f, marked.data());
    EXPECT_EQ(marked, expected);
    EXPECT_THAT(marked, testing::IsSupersetOf({0, 1}));
  }
}

TEST_P(PixelKernels, MarkPixelsAmidMarkedOnesAlsoInAShortRow) {
  for (const size_t num : {kWidth, size_t{19}, size_t{5}, size_t{2}}) {
    std::vector<std::vector<uint8_t>> rows(3);
    for (size_t v = 0; v < 3; ++v) {
      for (size_t u = 0; u < num; ++u) rows[v].push_back(Row(v)[u] > 0);
    }
    std::vector<uint8_t> expected(num, 9);
    for (size_t u = 1; u + 1 < num; ++u) {
      int sum = 0;
      for (const auto& row : rows) sum += row[u - 1] + row[u] + row[u + 1];
      expected[u] = rows[1][u] && sum >= 7;
    }
    std::vector<uint8_t> marked(num, 9);
    MarkAmid(rows[0].data(), rows[1].data(), rows[2].data(), num, 7, marked.data());
    EXPECT_EQ(marked, expected);
  }
}

TEST_P(PixelKernels, ClassifyHeightsAlsoOfAShortRow) {
  const HeightLimits limits{0.004f, 0.010f, 0.003f, 0.008f, 0.015f};
  for (const size_t num : {kWidth, size_t{5}}) {
    std::vector<uint8_t> expected;
    for (size_t u = 0; u < num; ++u) {
      const float value = Row(2)[u];
      const float residual = value - (0.1f * x()[u] + 1.2f);
      const bool foot =
          value > 0 && residual < 0.015f * value && residual > std::max(0.004f, 0.003f * value);
      const bool object = residual > std::max(0.010f, 0.008f * value);
      expected.push_back(static_cast<uint8_t>(foot + (foot && object)));
    }
    std::vector<uint8_t> classes(num, 9);
    ClassifyHeights(x(), Row(2), num, 0.1f, 1.2f, limits, classes.data());
    EXPECT_EQ(classes, expected);
    if (num == kWidth) {
      EXPECT_THAT(classes, testing::IsSupersetOf({0, 1, 2}));
    }
  }
}

TEST_P(PixelKernels, MarkMarkedPixelsOverARegion) {
  const float x_axis[] = {1, 0, 0}, y_axis[] = {0, 1, 0};
  // x > -0.03 m, y > -0.02 m, x + y < 0.01 m
  const float edges[] = {1, 0, 0.03f, 0, 1, 0.02f, -0.7071f, -0.7071f, 0.007071f};
  for (const size_t num : {kWidth, size_t{30}, size_t{5}}) {
    std::vector<uint8_t> marked, expected;
    for (size_t u = 0; u < num; ++u) {
      const float z = 1 / Row(5)[u];
      marked.push_back(Row(5)[u] > 0 && u % 3 > 0);
      expected.push_back(marked[u] && x()[u] * z > -0.03f && y(5) * z > -0.02f &&
                         x()[u] * z + y(5) * z < 0.01f);
    }
    std::vector<uint8_t> contained(num, 9);
    MarkContained(x(), y(5), Row(5), marked.data(), num, {x_axis, y_axis, edges, 3},
                  contained.data());
    EXPECT_EQ(contained, expected);
    MarkContained(x(), y(5), Row(5), marked.data(), num, {x_axis, y_axis, nullptr, 0},
                  contained.data());
    EXPECT_THAT(contained, testing::Each(0));
  }
}

TEST_P(PixelKernels, CountNearPointsUpToEnough) {
  constexpr float kLimit = 0.012f;
  for (const int enough : {3, 12, 100}) {
    for (size_t v = 0; v < kHeight; ++v) {
      std::vector<int32_t> counts(kWidth + kKernelPadding);
      CountNear(Window(v), kWidth, 3, kLimit, enough, counts.data());
      for (size_t u = 0; u < kWidth; ++u) {
        if (Row(v)[u] <= 0) continue;
        const auto num_near = [&](int half) {
          const std::vector<float> distances = Distances(v, u, half);
          return std::upper_bound(distances.begin(), distances.end(), kLimit) - distances.begin();
        };
        EXPECT_EQ(counts[u], std::min<int64_t>(enough, num_near(3))) << u << ", " << v;
      }
    }
  }
}

TEST_P(PixelKernels, AverageTheNearestDistances) {
  for (const int half : {1, 3, 7}) {
    for (const size_t num_nearest : {1u, 12u, 60u}) {
      for (size_t u = 0; u < kWidth; ++u) {
        const std::vector<float> distances = Distances(4, u, half);
        if (Row(4)[u] <= 0 || distances.empty()) continue;
        double sum = 0;
        for (size_t k = 0; k < num_nearest; ++k) {
          sum += distances[std::min(k, distances.size() - 1)];
        }
        const double expected = sum / static_cast<double>(num_nearest);
        const float mean = MeanOfNearest(Window(4), u, half, num_nearest, 0);
        EXPECT_NEAR(mean, expected, 1e-5 * expected + 1e-7);
        for (const float guess : {0.002f, 0.005f, 0.02f, 1.0f}) {
          EXPECT_EQ(MeanOfNearest(Window(4), u, half, num_nearest, guess), mean);
        }
      }
    }
  }
  std::fill(values_.begin(), values_.end(), 0.0f);
  values_[(4 + kMargin) * kStride + kMargin + 20] = 1;
  EXPECT_EQ(MeanOfNearest(Window(4), 20, 3, 12, 0.01f), HUGE_VALF);
}

}  // namespace
}  // namespace declutter
