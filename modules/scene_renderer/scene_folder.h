#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "modules/scene_renderer/scene_renderer.h"

namespace declutter {

// scene.json of a rendered scene: camera, table plane, objects with id, labels, shape, scope,
// n_px, seed_px, known_size (a box's sides from longest to shortest) and, under "truth", the exact
// pose in C, the size along the axes of O, the visible fraction and what it rests on. Scope is
// "core" from 300 labelled pixels on, "soft" below.
nlohmann::ordered_json DescribeScene(const RenderedScene& rendered, const std::string& id);

// Writes depth.png, rgb.png, labels.png, scene.json and scene.textproto, the scene without chance,
// into `folder`, which is made if it is not there. Throws std::runtime_error when that fails.
void WriteSceneFolder(const RenderedScene& rendered, const std::string& id,
                      const std::string& folder);

}  // namespace declutter
