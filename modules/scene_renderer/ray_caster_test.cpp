#include "modules/scene_renderer/ray_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

constexpr PinholeCamera kCamera{640, 480, 525, 525, 319.5, 239.5};

Solid Tilted(Shape shape, const Eigen::Vector3d& position, const Eigen::Vector3d& size) {
  Solid solid;
  solid.shape = shape;
  solid.X_CO.translation() = position;
  solid.X_CO.rotate(Eigen::AngleAxisd(2.2, Eigen::Vector3d(1, 0.2, -0.1).normalized()));
  solid.size = size;
  return solid;
}

// Distance of a point of O from the surface.
double SurfaceDistance(const Solid& solid, const Eigen::Vector3d& p_O) {
  const Eigen::Vector3d half = 0.5 * solid.size;
  if (solid.shape == Shape::kBox) return std::abs((p_O.cwiseAbs() - half).maxCoeff());
  return std::abs(std::max(p_O.head<2>().norm() - solid.radius(), std::abs(p_O.z()) - half.z()));
}

TEST(RayCasterTest, EveryPointLiesOnTheSurfaceOfItsSolid) {
  const std::vector<Solid> solids = {Tilted(Shape::kBox, {-0.1, 0, 0.8}, {0.1, 0.2, 0.15}),
                                     Tilted(Shape::kCylinder, {0.1, 0, 0.9}, {0.1, 0.1, 0.2})};
  const IdealImage image = CastRays(kCamera, solids);
  int num_seen[2] = {0, 0};
  for (size_t i = 0; i < image.z.size(); ++i) {
    if (image.solid[i] < 0) continue;
    const Solid& solid = solids[static_cast<size_t>(image.solid[i])];
    const Eigen::Vector3d p_C =
        kCamera.Ray(static_cast<double>(i % 640), static_cast<double>(i / 640)) *
        static_cast<double>(image.z[i]);
    ++num_seen[image.solid[i]];
    ASSERT_LT(SurfaceDistance(solid, solid.X_CO.inverse() * p_C), 1e-6);
  }
  EXPECT_GT(num_seen[0], 5000);
  EXPECT_GT(num_seen[1], 5000);
}

TEST(RayCasterTest, SeesTheNearFaceOfABoxStraightOn) {
  Solid box;
  box.X_CO.translation() = Eigen::Vector3d(0, 0, 1.1);
  box.size = Eigen::Vector3d(0.2, 0.1, 0.2);
  const IdealImage image = CastRays(kCamera, {box});
  const size_t centre = 240 * 640 + 320;
  EXPECT_FLOAT_EQ(image.z[centre], 1.0F);
  EXPECT_EQ(image.face[centre], 4);
  EXPECT_NEAR(image.incidence[centre], 1, 1e-5);
  // 0.2 m by 0.1 m at 1 m are 105 px by 52.5 px.
  EXPECT_NEAR(image.num_covered[0], 105 * 52.5, 106);
}

TEST(RayCasterTest, TheNearerSolidHidesTheOtherButNotItsCount) {
  Solid front, back;
  front.X_CO.translation() = Eigen::Vector3d(0, 0, 0.8);
  front.size = back.size = Eigen::Vector3d(0.1, 0.1, 0.1);
  back.X_CO.translation() = Eigen::Vector3d(0, 0, 1.6);
  const IdealImage image = CastRays(kCamera, {back, front});
  EXPECT_EQ(image.solid[240 * 640 + 320], 1);
  EXPECT_GT(image.num_covered[0], 900);
  EXPECT_EQ(std::count(image.solid.begin(), image.solid.end(), 0), 0);
}

}  // namespace
}  // namespace declutter
