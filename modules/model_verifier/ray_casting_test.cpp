#include "modules/model_verifier/ray_casting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace declutter {
namespace {

// A box or upright cylinder whose z axis looks back at the camera, centred on its optical axis.
Solid FacingSolid(Shape shape, double z, const Eigen::Vector3d& size) {
  Solid solid;
  solid.shape = shape;
  solid.X_CO.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  solid.X_CO.translation() = Eigen::Vector3d(0, 0, z);
  solid.size = size;
  return solid;
}

// An image of a flat wall at one depth [mm].
DepthImage Wall(int depth_mm) {
  DepthImage image;
  image.camera = {64, 48, 60, 60, 31.5, 23.5};
  image.counts.assign(64 * 48, static_cast<uint16_t>(depth_mm));
  return image;
}

// A support plane far behind everything.
Plane FarPlane() { return {-Eigen::Vector3d::UnitZ(), 5.0}; }

RayEvidence CastAt(const Solid& solid, const DepthImage& image, const Plane& support) {
  ObservedImage observed;
  observed.Set(image, support);
  return CastRays(solid, observed.every_pixel());
}

TEST(SolidCaster, KnowsTheDistanceToItsSurface) {
  const SolidCaster box(FacingSolid(Shape::kBox, 1.0, {0.2, 0.2, 0.1}));
  EXPECT_NEAR(box.SignedDistance(box.X_OC() * Eigen::Vector3d{0, 0, 1}), -0.05, 1e-12);
  EXPECT_NEAR(box.SignedDistance(box.X_OC() * Eigen::Vector3d{0, 0, 0.9}), 0.05, 1e-12);
  EXPECT_NEAR(box.SignedDistance(box.X_OC() * Eigen::Vector3d{0.13, 0, 0.91}), 0.05,
              1e-12);  // 3-4-5 from the edge
  const SolidCaster cylinder(FacingSolid(Shape::kCylinder, 1.0, {0.2, 0.2, 0.1}));
  EXPECT_NEAR(cylinder.SignedDistance(cylinder.X_OC() * Eigen::Vector3d{0.06, 0.08, 1.0}), 0,
              1e-12);
  EXPECT_NEAR(cylinder.SignedDistance(cylinder.X_OC() * Eigen::Vector3d{0, 0, 0.93}), 0.02, 1e-12);
}

TEST(CastRays, CountsWhatIsOnInFrontOfAndBehindTheSurface) {
  const Solid solid = FacingSolid(Shape::kBox, 1.0, {0.2, 0.2, 0.1});
  const auto cast = [&](int depth_mm) {
    const DepthImage image = Wall(depth_mm);
    return CastAt(solid, image, FarPlane());
  };
  const RayEvidence on = cast(950);
  EXPECT_GT(on.explained.size(), 100u);
  EXPECT_EQ(on.num_violating, 0);
  EXPECT_EQ(on.num_contradicting, 0);
  const RayEvidence in_front = cast(700);
  EXPECT_GT(in_front.num_occluded, 100);
  EXPECT_EQ(in_front.explained.size(), 0u);
  const RayEvidence behind = cast(1500);
  EXPECT_GT(behind.num_violating, 100);
  EXPECT_EQ(behind.num_occluded, 0);
  const RayEvidence unmeasured = cast(0);
  EXPECT_GT(unmeasured.num_unknown, 100);
  EXPECT_EQ(unmeasured.num_violating, 0);
}

TEST(CastRays, SeesThroughASolidThinnerThanItsTolerance) {
  for (const Shape shape : {Shape::kBox, Shape::kCylinder}) {
    const Solid thin = FacingSolid(shape, 1.0, {0.2, 0.2, 0.004});
    EXPECT_EQ(CastAt(thin, Wall(998), FarPlane()).num_violating, 0);
    EXPECT_GT(CastAt(thin, Wall(1020), FarPlane()).num_violating, 100);
  }
}

TEST(CastRays, TakesWhatIsOnAThinSolidForTheFaceThatIsSeen) {
  // 4 mm behind its upper face, nearer to the lower one, which looks away.
  for (const Shape shape : {Shape::kBox, Shape::kCylinder}) {
    const RayEvidence evidence =
        CastAt(FacingSolid(shape, 1.0, {0.2, 0.2, 0.006}), Wall(1001), FarPlane());
    EXPECT_GT(evidence.explained.size(), 100u);
    EXPECT_EQ(evidence.num_contradicting, 0);
  }
}

TEST(CastRays, LooksIntoAnOpenCylinderWithoutBlame) {
  const Solid solid = FacingSolid(Shape::kCylinder, 1.0, {0.2, 0.2, 0.1});
  const DepthImage image = Wall(1020);
  const RayEvidence evidence = CastAt(solid, image, FarPlane());
  EXPECT_GT(evidence.hollow.size(), 50u);
  EXPECT_EQ(evidence.num_violating, 0);
}

TEST(CastRays, LeavesTheSupportPlaneToItself) {
  const Solid solid = FacingSolid(Shape::kBox, 1.0, {0.2, 0.2, 0.1});
  const DepthImage image = Wall(950);
  const Plane wall{-Eigen::Vector3d::UnitZ(), 0.95};
  EXPECT_EQ(CastAt(solid, image, wall).explained.size(), 0u);
}

TEST(CastRays, CountsATopFaceThatGoesOnBesideTheSolid) {
  const Solid solid = FacingSolid(Shape::kBox, 1.0, {0.2, 0.2, 0.1});
  EXPECT_GT(CastAt(solid, Wall(950), FarPlane()).num_overhanging(), 20);
  EXPECT_EQ(CastAt(solid, Wall(965), FarPlane()).num_overhanging(), 0);
}

TEST(CastRays, LeavesATopBesideTheSolidToWhatExplainsIt) {
  const Solid solid = FacingSolid(Shape::kBox, 1.0, {0.2, 0.2, 0.1});
  const DepthImage image = Wall(950);
  const RayEvidence evidence = CastAt(solid, image, FarPlane());
  std::vector<uint8_t> num_explaining(image.counts.size(), 0);
  EXPECT_EQ(NumOverhangingAlone(evidence, num_explaining), evidence.num_overhanging());
  for (size_t i = 0; i < 20; ++i) {
    num_explaining[static_cast<size_t>(evidence.overhanging[i])] = 1;
  }
  EXPECT_EQ(NumOverhangingAlone(evidence, num_explaining), evidence.num_overhanging() - 20);
}

struct ObservedWall {
  DepthImage image = Wall(950);
  Plane support = FarPlane();
  ObservedImage observed;

  ObservedWall() { observed.Set(image, support); }
};

TEST(CastRays, CountsAboutTheSameAtEverySecondPixel) {
  const Solid solid = FacingSolid(Shape::kBox, 1.0, {0.2, 0.2, 0.1});
  const ObservedWall wall;
  const RayEvidence all = CastRays(solid, wall.observed.every_pixel());
  const RayEvidence some = CastRays(solid, wall.observed.every_second_pixel());
  EXPECT_EQ(some.pixel_weight, 4);
  EXPECT_NEAR(some.num_explained(), all.num_explained(), 0.2 * all.num_explained());
  EXPECT_NEAR(some.Balance(), all.Balance(), 0.2 * all.Balance());
}

TEST(CastRays, LeavesPixelsToTheirOwners) {
  const Solid solid = FacingSolid(Shape::kBox, 1.0, {0.2, 0.2, 0.1});
  const ObservedWall wall;
  const Observation observation = wall.observed.every_pixel();
  const RayEvidence all = CastRays(solid, observation);
  std::vector<uint8_t> owners(wall.image.counts.size(), 0);
  for (size_t i = 0; i < 20; ++i) owners[static_cast<size_t>(all.explained[i])] = 2;
  const RayEvidence own = CastRays(solid, observation.For(2, owners));
  EXPECT_EQ(own.Fit(), all.Fit());
  const RayEvidence rest = CastRays(solid, observation.For(1, owners));
  EXPECT_TRUE(std::equal(rest.explained.begin(), rest.explained.end(), all.explained.begin() + 20,
                         all.explained.end()));
  EXPECT_EQ(rest.fit_sum, std::accumulate(all.fits.begin() + 20, all.fits.end(), int64_t{0}));
}

}  // namespace
}  // namespace declutter
