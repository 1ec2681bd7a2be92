#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/plane.h"
#include "modules/geometry/solid.h"
#include "modules/scene_renderer/scene.pb.h"

namespace declutter {

// An object of a rendered scene as it really is.
struct TrueObject {
  int32_t id = 0;                       // 2, 3, ... in the order of the scene
  uint8_t label = 0;                    // its value in the label image
  Solid solid;                          // in C
  int32_t rests_on = 0;                 // id of the object below; 0: the table, or nothing listed
  int32_t num_px = 0;                   // pixels with its label
  int32_t num_visible_px = 0;           // pixels that see it, with depth or without
  int32_t num_unoccluded_px = 0;        // pixels that would see it alone in the image
  std::array<int, 2> seed_px = {0, 0};  // u, v of a pixel with its label far from its outline

  double visible_fraction() const {
    return num_unoccluded_px > 0 ? static_cast<double>(num_visible_px) / num_unoccluded_px : 0.0;
  }
};

// A scene, what the sensor saw of it and what is true.
struct RenderedScene {
  DepthImage depth;
  ColorImage color;
  std::vector<uint8_t> labels;  // row-major; only where there is depth; see LabelOf
  std::vector<TrueObject> objects;
  Plane table;  // in C
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  Scene scene;  // the scene with every object stated, none left to chance
};

// Label of the table's top and sides; floor and walls have label 0.
constexpr uint8_t kTableLabel = 1;
// Ids are counted from 2: the scheme of labels keeps 1..9 for the table.
constexpr int32_t kFirstObjectId = 2;
// Objects a scene can have.
constexpr int kMaxObjects = 144;

// Label of the object of an id: 10 id for ids 2..25. Later ids share those tens, 24 ids a round:
// 26 has 21, 27 has 31, ..., 50 has 22.
uint8_t LabelOf(int32_t id);

// Renders a scene. `seed` drives the random layout, unless the scene fixes it, and the noise;
// `frame` only the part of the noise that changes from frame to frame. Throws std::invalid_argument
// for a scene that cannot be: objects that overlap, clutter that cannot be reached.
RenderedScene Render(const Scene& scene, uint64_t seed, uint64_t frame = 0);

}  // namespace declutter
