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

// Which of several certain solids are kept where the box is.
std::vector<uint8_t> Kept(const RenderedScene& scene, const std::vector<Solid>& solids) {
  ObservedImage observed;
  observed.Set(scene.depth, scene.table);
  const Observation observation = observed.every_pixel();
  std::vector<ObjectModel> objects(solids.size());
  std::vector<RayEvidence> evidence(solids.size());
  for (size_t i = 0; i < solids.size(); ++i) {
    objects[i].solid = solids[i];
    objects[i].confidence = 1;
    CastRays(solids[i], observation, &evidence[i]);
  }
  return SupportedObjects(ModelVerifierConfig())
      .Find(objects, evidence, observation.grid.num_pixels());
}

TEST(SupportedObjects, OfTwoInOnePlaceKeepsTheOneOfWhichALargerShareSpeaksAlone) {
  const RenderedScene scene = Render(ParseScene(kBox, "scene"), 1);
  const Solid& whole = scene.objects[0].solid;
  const Solid part = Longer(whole, 1, 1, -0.03);  // the same front
  EXPECT_THAT(Kept(scene, {whole}), ElementsAre(1));
  EXPECT_THAT(Kept(scene, {whole, part}), ElementsAre(1, 0));
  EXPECT_THAT(Kept(scene, {part, whole}), ElementsAre(0, 1));
}

TEST(SupportedObjects, WhatIsDroppedAsUncertainTakesNothingFromOthers) {
  const RenderedScene scene = Render(ParseScene(kBox, "scene"), 1);
  ObservedImage observed;
  observed.Set(scene.depth, scene.table);
  std::vector<ObjectModel> objects(2);
  std::vector<RayEvidence> evidence(2);
  for (size_t i = 0; i < 2; ++i) {
    objects[i].solid = scene.objects[0].solid;
    CastRays(objects[i].solid, observed.every_pixel(), &evidence[i]);
  }
  objects[0].confidence = 0.5f;
  objects[1].confidence = 0.6f;
  EXPECT_THAT(SupportedObjects(ModelVerifierConfig())
                  .Find(objects, evidence, observed.every_pixel().grid.num_pixels()),
              ElementsAre(0, 1));
}

}  // namespace
}  // namespace declutter
