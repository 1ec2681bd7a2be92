#include "modules/scene_renderer/shadow.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

// A row of 100 px: a wall at 1 m and, on columns 40 to 69, a plate at 0.5 m. fx = 100 px.
IdealImage PlateBeforeWall() {
  IdealImage ideal;
  ideal.camera = {100, 1, 100, 100, 49.5, 0};
  ideal.z.assign(100, 1);
  ideal.solid.assign(100, 0);
  for (size_t u = 40; u < 70; ++u) {
    ideal.z[u] = 0.5F;
    ideal.solid[u] = 1;
  }
  return ideal;
}

std::vector<size_t> Hidden(const SceneNoise& noise) {
  const std::vector<uint8_t> mask = ShadowMask(PlateBeforeWall(), noise, 1);
  std::vector<size_t> columns;
  for (size_t u = 0; u < mask.size(); ++u) {
    if (mask[u]) columns.push_back(u);
  }
  return columns;
}

TEST(ShadowTest, ProjectorToTheRightHidesTheWallLeftOfThePlate) {
  SceneNoise noise;
  noise.set_projector_x_m(0.052);  // shifts the plate by 10.4 px, the wall by 5.2 px
  noise.set_infrared_camera_x_m(0);
  noise.set_min_projector_closing_px(0);
  noise.set_max_projector_closing_px(0);
  EXPECT_EQ(Hidden(noise), (std::vector<size_t>{35, 36, 37, 38, 39}));
}

TEST(ShadowTest, InfraredCameraToTheLeftHidesTheWallRightOfThePlate) {
  SceneNoise noise;
  noise.set_projector_x_m(0);
  noise.set_infrared_camera_x_m(-0.032);
  noise.set_min_infrared_closing_px(0);
  noise.set_max_infrared_closing_px(0);
  EXPECT_EQ(Hidden(noise), (std::vector<size_t>{70, 71, 72}));
}

TEST(ShadowTest, ClosesTheEndOfAShadowThatIsAwayFromThePlate) {
  SceneNoise noise;
  noise.set_projector_x_m(0.052);
  noise.set_infrared_camera_x_m(0);
  noise.set_min_projector_closing_px(2);
  noise.set_max_projector_closing_px(2);
  EXPECT_EQ(Hidden(noise), (std::vector<size_t>{37, 38, 39}));
}

}  // namespace
}  // namespace declutter
