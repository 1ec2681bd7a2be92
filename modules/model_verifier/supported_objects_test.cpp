#include "modules/model_verifier/supported_objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/model_verifier/extents.h"
#include "modules/scene_renderer/scene_renderer.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter {
namespace {

using testing::ElementsAre;

constexpr char kBox[] = "object { box { size_x_m: 0.12 size_y_m: 0.1 size_z_m: 0.12 } y_m: 0.65 }";

ObjectModel Object(const Solid& solid, float confidence = 1) {
  ObjectModel object;
  object.solid = solid;
  object.confidence = confidence;
  return object;
}

// Which of several objects are kept where the box is.
std::vector<uint8_t> Kept(const RenderedScene& scene, const std::vector<ObjectModel>& objects) {
  ObservedImage observed;
  observed.Set(scene.depth, scene.table);
  const Observation observation = observed.every_pixel();
  std::vector<RayEvidence> evidence;
  for (const ObjectModel& object : objects) {
    evidence.push_back(CastRays(object.solid, observation));
  }
  return SupportedObjects(ModelVerifierConfig())
      .Find(objects, evidence, observation.grid.num_pixels());
}

TEST(SupportedObjects, OfTwoInOnePlaceKeepsTheOneOfWhichALargerShareSpeaksAlone) {
  const RenderedScene scene = Render(ParseScene(kBox, "scene"), 1);
  const ObjectModel whole = Object(scene.objects[0].solid);
  const ObjectModel part = Object(Longer(whole.solid, 1, 1, -0.03));  // the same front
  EXPECT_THAT(Kept(scene, {whole}), ElementsAre(1));
  EXPECT_THAT(Kept(scene, {whole, part}), ElementsAre(1, 0));
  EXPECT_THAT(Kept(scene, {part, whole}), ElementsAre(0, 1));
}

TEST(SupportedObjects, WhatIsDroppedAsUncertainTakesNothingFromOthers) {
  const RenderedScene scene = Render(ParseScene(kBox, "scene"), 1);
  const Solid& box = scene.objects[0].solid;
  EXPECT_THAT(Kept(scene, {Object(box, 0.5f), Object(box, 0.6f)}), ElementsAre(0, 1));
}

}  // namespace
}  // namespace declutter
