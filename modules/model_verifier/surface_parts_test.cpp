#include "modules/model_verifier/surface_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/geometry/plane.h"
#include "modules/model_verifier/test_scene.h"

namespace declutter {
namespace {

using testing::SizeIs;

// The parts of all objects of a scene.
std::vector<SurfacePart> PartsOf(const std::string& objects) {
  const ObservedScene seen(objects);
  const RenderedScene& scene = seen.scene;
  const Observation observation = seen.observed.every_second_pixel();
  const PixelGrid& grid = observation.grid;
  std::vector<uint8_t> is_marked(static_cast<size_t>(grid.num_pixels()), 0);
  for (int v = 0; v < grid.rows; ++v) {
    for (int u = 0; u < grid.columns; ++u) {
      const auto label =
          scene.labels[static_cast<size_t>(2 * v * scene.depth.camera.width + 2 * u)];
      for (const TrueObject& object : scene.objects) {
        if (label == object.label) is_marked[static_cast<size_t>(v * grid.columns + u)] = 1;
      }
    }
  }
  PartFinder finder;
  const SurfaceParts& parts = finder.Find(is_marked, {0, grid.columns, 0, grid.rows},
                                          TableFrame(scene.table), 40, observation);
  return {parts.begin(), parts.end()};
}

TEST(PartFinder, KeepsTheTopAndTheSidesOfABoxTogether) {
  const auto parts =
      PartsOf("object { box { size_x_m: 0.1 size_y_m: 0.08 size_z_m: 0.1 } y_m: 0.65 }");
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_GT(parts[0].tops.size(), 200u);
  EXPECT_GT(parts[0].sides.size(), 200u);
}

TEST(PartFinder, PartsNeighboursOfDifferentHeights) {
  const auto parts = PartsOf(
      "object { box { size_x_m: 0.08 size_y_m: 0.08 size_z_m: 0.1 } y_m: 0.65 }"
      "object { box { size_x_m: 0.08 size_y_m: 0.08 size_z_m: 0.07 } x_m: 0.081 y_m: 0.65 }");
  ASSERT_THAT(parts, SizeIs(2));
}

TEST(PartFinder, OutlinesATopOnlyWhereNothingHidesTheRest) {
  // Of the lower box, the taller one in front hides the front edge.
  const auto parts = PartsOf(
      "object { box { size_x_m: 0.3 size_y_m: 0.04 size_z_m: 0.12 } y_m: 0.55 }"
      "object { box { size_x_m: 0.08 size_y_m: 0.2 size_z_m: 0.03 } y_m: 0.72 }");
  ASSERT_THAT(parts, SizeIs(2));
  const SurfacePart& lower = parts[0].tops[0].z() < parts[1].tops[0].z() ? parts[0] : parts[1];
  float nearest = 1;
  for (const Eigen::Vector3f& p : lower.tops) nearest = std::min(nearest, p.y());
  size_t num_on_cut = 0;
  for (const Eigen::Vector2f& p : lower.outline) {
    // The edges on the left and on the right end at the occluder too.
    num_on_cut += std::abs(p.x()) < 0.03f && p.y() < nearest + 0.02f;
  }
  EXPECT_GT(lower.outline.size(), 30u);
  EXPECT_LT(num_on_cut, lower.outline.size() / 20);
}

}  // namespace
}  // namespace declutter
