#pragma once

#include <cstdint>
#include <string>

#include "modules/model_verifier/observation.h"
#include "modules/scene_renderer/scene_renderer.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter {

// For tests: a scene, rendered from its text, with what is observed of it.
struct ObservedScene {
  explicit ObservedScene(const std::string& text, uint64_t seed = 1)
      : scene(Render(ParseScene(text, "scene"), seed)) {
    observed.Set(scene.depth, scene.table);
  }
  ObservedScene(const ObservedScene&) = delete;  // observed looks at the scene of its own
  ObservedScene& operator=(const ObservedScene&) = delete;

  RenderedScene scene;
  ObservedImage observed;
};

}  // namespace declutter
