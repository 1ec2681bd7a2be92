#include "modules/feature_estimator/horizontal_curvature.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "modules/feature_estimator/test_surfaces.h"

namespace declutter {
namespace {

using ::testing::Each;
using ::testing::FloatNear;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr CurvatureWindow kWindow{{0.030, 6}, 0.52, 0.12};

// Horizontal curvature of the points `select` picks.
std::vector<float> KappaOf(const Tabletop& tabletop,
                           const std::function<bool(const Eigen::Vector3d&)>& select) {
  const PointImage points = MakePointImage(tabletop, kWindow.neighborhood.radius_m);
  const NormalImage normals = EstimateNormals(points, {0.015}, 8);
  const std::vector<float> kappa =
      EstimateHorizontalCurvature(points, normals, kUp_C, kWindow).kappa;
  std::vector<float> selected;
  for (size_t i = 0; i < kappa.size(); ++i) {
    if (points.HasPoint(i) && select({points.x[i], points.y[i], points.z[i]})) {
      selected.push_back(kappa[i]);
    }
  }
  return selected;
}

class HorizontalCurvatureOfACylinder : public ::testing::TestWithParam<double> {};

TEST_P(HorizontalCurvatureOfACylinder, IsTheReciprocalOfItsRadius) {
  const double radius_m = GetParam();
  const Tabletop tabletop = Observe(CylinderSurface({0, 0, 0.8}, radius_m));
  const auto is_in_the_middle = [&](const Eigen::Vector3d& p) {
    return std::abs(p.x()) < 0.25 * radius_m && std::abs(p.y()) < 0.05;
  };
  const auto expected = static_cast<float>(1 / radius_m);
  // n . t is the sine of the angle, so a wide window falls short on a small radius.
  std::vector<float> kappa = KappaOf(tabletop, is_in_the_middle);
  ASSERT_THAT(kappa, Not(IsEmpty()));
  EXPECT_THAT(kappa, Each(FloatNear(expected, 0.12F * expected)));
}

INSTANTIATE_TEST_SUITE_P(Radii, HorizontalCurvatureOfACylinder,
                         ::testing::Values(0.030, 0.040, 0.060, 0.080, 0.100));

TEST(HorizontalCurvature, IsNegativeInAHollow) {
  const Tabletop tabletop = Observe(CylinderSurface({0, 0, 0.7}, 0.060, +1));
  const std::vector<float> kappa =
      KappaOf(tabletop, [](const auto& p) { return std::abs(p.x()) < 0.015; });
  ASSERT_THAT(kappa, Not(IsEmpty()));
  EXPECT_THAT(kappa, Each(FloatNear(-1 / 0.060F, 2)));
}

TEST(HorizontalCurvature, OfAPlaneIsZero) {
  const Tabletop tabletop = Observe(PlaneSurface({0, 0, 0.8}, {0.5, 0, -0.9}));
  const std::vector<float> kappa = KappaOf(tabletop, [](const auto&) { return true; });
  ASSERT_THAT(kappa, Not(IsEmpty()));
  EXPECT_THAT(kappa, Each(FloatNear(0, 0.2F)));
}

TEST(HorizontalCurvature, OfATopFaceIsZero) {
  const Tabletop tabletop = Observe(PlaneSurface({0, 0.06, 0.6}, kUp_C), 0.0005);
  const std::vector<float> kappa = KappaOf(tabletop, [](const auto& p) { return p.z() < 0.65; });
  ASSERT_THAT(kappa, Not(IsEmpty()));
  EXPECT_THAT(kappa, Each(0));
}

TEST(HorizontalCurvature, StaysFlatBesideTheEdgeOfABox) {
  const Surface left = PlaneSurface({0, 0, 0.8}, {-1, 0, -1});
  const Surface right = PlaneSurface({0, 0, 0.8}, {1, 0, -1});
  const Surface box = [=](const Eigen::Vector3d& ray) { return std::max(left(ray), right(ray)); };
  const auto is_beside_the_edge = [](const Eigen::Vector3d& p) {
    const double distance_m = std::abs(p.x()) * std::sqrt(2.0);
    return distance_m > 0.016 && distance_m < 0.030;
  };
  const std::vector<float> kappa = KappaOf(Observe(box, 0.0005), is_beside_the_edge);
  ASSERT_THAT(kappa, Not(IsEmpty()));
  // Flatter than the widest round object.
  EXPECT_THAT(kappa, Each(FloatNear(0, 1 / 0.120F)));
}

}  // namespace
}  // namespace declutter
