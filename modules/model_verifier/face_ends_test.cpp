#include "modules/model_verifier/face_ends.h"

#include <gtest/gtest.h>

#include <hwy/targets.h>
#include <cmath>
#include <string>

#include "modules/model_verifier/face_end_kernels.h"
#include "modules/model_verifier/projection.h"
#include "modules/model_verifier/test_scene.h"

namespace declutter {
namespace {

// Its right and its left end are not seen, its top and its front are.
constexpr char kBox[] = "object { box { size_x_m: 0.2 size_y_m: 0.1 size_z_m: 0.1 } y_m: 0.7 }";
constexpr char kNoNoise[] = "noise { model: \"none\" }";

RenderedScene RenderWith(const std::string& others) {
  return Render(ParseScene(kBox + others + kNoNoise, "scene"), 1);
}

// The end at +x of the true box moved outward.
Solid WithEndMoved(const Solid& truth, double growth) {
  Solid moved = truth;
  moved.size.x() += growth;
  moved.X_CO.translation() += 0.5 * growth * truth.X_CO.linear().col(0);
  return moved;
}

std::optional<double> ShiftOf(const RenderedScene& scene, const Solid& solid) {
  ObservedImage observed;
  observed.Set(scene.depth, scene.table);
  return ShiftOfEnd(solid, 0, 1, observed.every_pixel());
}

void ExpectComesBack(const RenderedScene& scene, double tolerance) {
  for (const double error : {-0.008, 0.0, 0.008}) {
    const auto shift = ShiftOf(scene, WithEndMoved(scene.objects[0].solid, error));
    ASSERT_TRUE(shift);
    EXPECT_NEAR(*shift, -error, tolerance) << error;
  }
}

TEST(ShiftOfEnd, LeadsToWhereTheFacesEnd) { ExpectComesBack(RenderWith(""), 0.0003); }

TEST(ShiftOfEnd, IsNotMovedByWhatHidesAPartOfTheEdge) {
  ExpectComesBack(RenderWith("object { box { size_x_m: 0.06 size_y_m: 0.03 size_z_m: 0.12 } "
                             "x_m: 0.1 y_m: 0.6 }"),
                  0.0005);
}

TEST(ShiftOfEnd, IsNotMovedByWhatGoesOnBesideAPartOfTheEdge) {
  ExpectComesBack(RenderWith("object { box { size_x_m: 0.06 size_y_m: 0.03 size_z_m: 0.1 } "
                             "x_m: 0.1302 y_m: 0.72 }"),
                  0.0005);
}

TEST(ShiftOfEnd, IsNotMovedByASideThatRisesAtTheEdge) {
  ExpectComesBack(RenderWith("object { box { size_x_m: 0.06 size_y_m: 0.1 size_z_m: 0.2 } "
                             "x_m: 0.1302 y_m: 0.72 }"),
                  0.002);
}

TEST(ShiftOfEnd, LeavesAnEndOfWhichNothingIsSeen) {
  const RenderedScene scene = RenderWith(
      "object { box { size_x_m: 0.1 size_y_m: 0.03 size_z_m: 0.25 } x_m: 0.08 y_m: 0.6 }");
  const auto shift = ShiftOf(scene, scene.objects[0].solid);
  EXPECT_EQ(shift.value_or(0), 0);
}

TEST(ShiftOfEnd, IsWhereTheOtherObjectBegins) {
  // A second box continues the first one; who each pixel belongs to is known.
  const RenderedScene scene = RenderWith(
      "object { box { size_x_m: 0.06 size_y_m: 0.1 size_z_m: 0.1 } x_m: 0.1302 y_m: 0.7 }");
  const Solid longer = WithEndMoved(scene.objects[0].solid, 0.006);
  EXPECT_GT(ShiftOf(scene, longer).value_or(0), -0.001);
  ObservedImage observed;
  observed.Set(scene.depth, scene.table);
  const Observation all = observed.every_pixel();
  PixelGrid grid = all.grid;
  for (int v = 0; v < grid.rows; ++v) {
    for (int u = 0; u < grid.columns; ++u) {
      const bool is_other =
          scene.labels[static_cast<size_t>(v * grid.columns + u)] == scene.objects[1].label;
      if (is_other) grid.z[static_cast<size_t>(v) * grid.stride + static_cast<size_t>(u)] *= -1;
    }
  }
  const auto shift = ShiftOfEnd(longer, 0, 1, all.At(grid));
  ASSERT_TRUE(shift);
  EXPECT_NEAR(*shift, -0.006, 0.0005);
}

TEST(AddToProfile, GivesTheSameWithEveryInstructionSet) {
  const ObservedScene seen(kBox);
  const Solid& box = seen.scene.objects[0].solid;
  const RayWindow window = WindowOf(box, 0.02, seen.observed.every_pixel());
  const RaySolid solid = AsRaySolid(box, seen.scene.table);
  constexpr FaceLimits kLimits = {0.005f, 0.006f, 0.05f, 0.7f, 0.004f, 0.0005f, -0.015f};
  EndProfile first;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    EndProfile profile;
    AddToProfile(solid, window, kLimits, {2, 1, 0, 1}, &profile);
    int num_there = 0, num_gone = 0, num_unknown = 0;
    for (int i = 0; i < EndProfile::kNumBins; ++i) {
      num_there += profile.there[i];
      num_gone += profile.gone[i];
      num_unknown += profile.unknown[i];
    }
    EXPECT_GT(num_there, 100);
    EXPECT_GT(num_gone, 100);
    EXPECT_GT(num_unknown, 10);
    if (target == hwy::SupportedAndGeneratedTargets().front()) first = profile;
    for (int i = 0; i < EndProfile::kNumBins; ++i) {
      EXPECT_EQ(profile.there[i], first.there[i]) << hwy::TargetName(target);
      EXPECT_EQ(profile.gone[i], first.gone[i]) << hwy::TargetName(target);
      EXPECT_EQ(profile.unknown[i], first.unknown[i]) << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

}  // namespace
}  // namespace declutter
