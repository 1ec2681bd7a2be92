#include "modules/model_verifier/fit_sums.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace declutter {
namespace {

constexpr size_t kNum = 4003;  // no multiple of lanes

// Points anywhere around a solid, on any of its surfaces; behind the last one is what was there.
struct RandomPoints {
  std::vector<float> buffer = std::vector<float>(10 * (kNum + kRayPadding), NAN);
  std::vector<int32_t> surfaces = std::vector<int32_t>(kNum + kRayPadding, -1);
  FitArrays arrays;

  RandomPoints() {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> place(-0.1f, 0.1f), direction(-1, 1), size(0.001f, 0.01f);
    std::uniform_int_distribution<int32_t> bits(0, 63);
    float* next = buffer.data();
    const auto fill = [&](auto& draw) {
      float* const begin = next;
      std::generate_n(begin, kNum, [&] { return draw(engine); });
      next += kNum + kRayPadding;
      return begin;
    };
    for (float*& p : arrays.p) p = fill(place);
    for (float*& n : arrays.n) n = fill(direction);
    for (float*& ray : arrays.ray) ray = fill(direction);
    arrays.sigma = fill(size);
    std::generate_n(surfaces.begin(), kNum, [&] { return bits(engine); });
    for (size_t i = 0; i < kNum; i += 5) {
      for (float* n : arrays.n) n[i] = 0;
    }
    arrays.surfaces = surfaces.data();
    arrays.num = kNum;
  }

  // Of a point on a plane.
  double Weight(double cosine, size_t i) const {
    const double sigma = arrays.sigma[i] * std::max(std::abs(cosine), 0.5);
    return 1 / (sigma * sigma);
  }
};

void ExpectNear(double sum, double expected) {
  EXPECT_NEAR(sum, expected, 1e-5 * std::abs(expected) + 0.1);  // a point weighs 1e4 or more
}

FaceRegion FaceAcross(int axis) { return {axis, -1, {0.09f, 0.08f, 0.07f}, 0.01f}; }

TEST(FitSums, OfAFaceAreThoseOfItsPoints) {
  const RandomPoints points;
  const FitArrays& a = points.arrays;
  for (int axis = 0; axis < 3; ++axis) {
    const FaceRegion region = FaceAcross(axis);
    FaceSums expected;
    for (size_t i = 0; i < kNum; ++i) {
      bool is_within = (a.surfaces[i] & SurfaceBit(axis, -1)) != 0;
      const float distance = std::abs(a.p[axis][i] + region.half_size[axis]);
      for (int k = 0; k < 3; ++k) {
        if (k == axis) continue;
        is_within &= std::abs(a.p[k][i]) <= region.half_size[k] - 0.01f;
        const bool is_on_other = (a.surfaces[i] & (SurfaceBit(k, 1) | SurfaceBit(k, -1))) != 0;
        is_within &=
            !is_on_other || std::abs(std::abs(a.p[k][i]) - region.half_size[k]) >= distance;
      }
      if (!is_within) continue;
      const double w = points.Weight(a.ray[axis][i], i);
      const double x = a.p[axis][i] + region.half_size[axis];
      const double lever = axis == 0 ? a.p[1][i] : axis == 1 ? -a.p[0][i] : 0;
      ++expected.num;
      expected.w += w;
      expected.wx += w * x;
      expected.wl += w * lever;
      expected.wll += w * lever * lever;
      expected.wlx += w * lever * x;
    }
    const FaceSums sums = SumFace(a, region);
    EXPECT_EQ(sums.num, expected.num);
    EXPECT_GT(sums.num, 50);
    ExpectNear(sums.w, expected.w);
    ExpectNear(sums.wx, expected.wx);
    ExpectNear(sums.wl, expected.wl);
    ExpectNear(sums.wll, expected.wll);
    ExpectNear(sums.wlx, expected.wlx);
  }
}

// Where the ray through a point, seen from above, first meets the circle of Side(); nothing for one
// on the far side.
struct Foot {
  Eigen::Vector2d n;    // outward normal there
  double cosine = 0;    // of incidence
  double distance = 0;  // [m] of the point outside the tangent there
};

std::optional<Foot> FootOnSide(const Eigen::Vector2d& p, const Eigen::Vector2d& ray) {
  const double radius = 0.06;
  const Eigen::Vector2d u = ray.normalized();
  const Eigen::Vector2d nearest = p - p.dot(u) * u;
  const double half_chord = std::sqrt(radius * radius - nearest.squaredNorm());
  if (!(half_chord > 0) || p.dot(u) > 0) return std::nullopt;
  const Eigen::Vector2d met = nearest - half_chord * u;
  const Eigen::Vector2d n = met / radius;
  return Foot{n, -n.dot(ray), n.dot(p - met)};
}

SideRegion Side() { return {0.01f, -0.02f, 0.06f, 0.005f, 3, 0.2f, 0.3f}; }

TEST(FitSums, OfASideAreThoseOfItsPoints) {
  const RandomPoints points;
  const FitArrays& a = points.arrays;
  SideSums expected;
  for (size_t i = 0; i < kNum; ++i) {
    if ((a.surfaces[i] & kCylinderSideBit) == 0) continue;
    const auto foot = FootOnSide({a.p[0][i] - 0.01, a.p[1][i] + 0.02}, {a.ray[0][i], a.ray[1][i]});
    if (!foot) continue;
    const double nx = foot->n.x(), ny = foot->n.y(), r = foot->distance;
    const bool is_turned_away = a.n[2][i] != 0 && nx * a.n[0][i] + ny * a.n[1][i] < 0.3;
    const double tolerance = std::max(0.005, 3.0 * a.sigma[i]) * std::max(foot->cosine, 0.5);
    if (std::abs(r) > tolerance || foot->cosine < 0.2 || is_turned_away) continue;
    const double sigma = a.sigma[i] * foot->cosine;
    const double w = 1 / (sigma * sigma);
    ++expected.num;
    expected.w += w;
    expected.nx += w * nx;
    expected.ny += w * ny;
    expected.nxnx += w * nx * nx;
    expected.nxny += w * nx * ny;
    expected.nyny += w * ny * ny;
    expected.r += w * r;
    expected.nxr += w * nx * r;
    expected.nyr += w * ny * r;
  }
  const SideSums sums = SumSide(a, Side());
  EXPECT_EQ(sums.num, expected.num);
  EXPECT_GT(sums.num, 30);
  ExpectNear(sums.w, expected.w);
  ExpectNear(sums.nx, expected.nx);
  ExpectNear(sums.ny, expected.ny);
  ExpectNear(sums.nxnx, expected.nxnx);
  ExpectNear(sums.nxny, expected.nxny);
  ExpectNear(sums.nyny, expected.nyny);
  ExpectNear(sums.r, expected.r);
  ExpectNear(sums.nxr, expected.nxr);
  ExpectNear(sums.nyr, expected.nyr);
}

TEST(FitSums, OfADiscAreThoseOfItsPoints) {
  const RandomPoints points;
  const FitArrays& a = points.arrays;
  DiscSums expected;
  for (size_t i = 0; i < kNum; ++i) {
    if ((a.surfaces[i] & SurfaceBit(2, 1)) == 0) continue;
    if (std::hypot(a.p[0][i] - 0.01, a.p[1][i] + 0.02) > 0.05) continue;
    const double w = points.Weight(a.ray[2][i], i);
    ++expected.num;
    expected.w += w;
    expected.wz += w * (a.p[2][i] - 0.03);
  }
  const DiscSums sums = SumDisc(a, {0.01f, -0.02f, 0.05f, 0.03f});
  EXPECT_EQ(sums.num, expected.num);
  EXPECT_GT(sums.num, 30);
  ExpectNear(sums.w, expected.w);
  ExpectNear(sums.wz, expected.wz);
}

TEST(FitSums, AreTheSameWithEveryInstructionSet) {
  const RandomPoints points;
  std::optional<std::vector<double>> first;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    const FaceSums face = SumFace(points.arrays, FaceAcross(1));
    const SideSums side = SumSide(points.arrays, Side());
    const DiscSums disc = SumDisc(points.arrays, {0.01f, -0.02f, 0.05f, 0.03f});
    const std::vector<double> sums = {face.w,   face.wx,  face.wl,   face.wll,  face.wlx,  side.w,
                                      side.nx,  side.ny,  side.nxnx, side.nxny, side.nyny, side.r,
                                      side.nxr, side.nyr, disc.w,    disc.wz};
    if (!first) first = sums;
    EXPECT_EQ(sums, *first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

}  // namespace
}  // namespace declutter
