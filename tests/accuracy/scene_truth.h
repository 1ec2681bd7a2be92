#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "modules/geometry/solid.h"

namespace declutter::accuracy {

// What is asked for a true object: core must be found, soft may be, of out no standing box and no
// upright cylinder may be reported, unscored has a truth too doubtful to count.
enum class Scope : int8_t { kCore, kSoft, kOut, kUnscored };

// How an object, true or modelled, is placed on its support.
enum class Stance : int8_t { kStanding, kLying, kLeaning, kUnknown };

struct TrueObject {
  int id = 0;
  std::string name;            // product or name
  std::optional<Shape> shape;  // empty: neither box nor cylinder
  std::string shape_name;
  Stance stance = Stance::kUnknown;
  Scope scope = Scope::kCore;
  std::vector<int> labels;              // its values in the label image; empty: known by its seed
  Eigen::Vector2i seed_px{-1, -1};      // a pixel well inside it
  std::optional<Eigen::Vector3d> size;  // [m] as Solid::size; axes of a box in no known order
  std::optional<double> size_tolerance_m;  // how well size is known
  std::optional<Solid> solid;              // exact pose and size, of rendered scenes
  std::optional<double> distance_m;        // depth of its centre or of a point on it
  std::optional<int> num_px;               // of it in the image
  std::optional<double> visible_fraction;  // visible pixels over those of the object alone
  std::optional<double> radius_bound_m;    // the least standard deviation an estimate can have
};

struct SceneTruth {
  std::string frame;               // as the exporter names it
  std::string group;               // the scenes it is counted with
  Eigen::Vector3d up_C{0, -1, 0};  // normal of the main support, toward the camera
  std::vector<TrueObject> objects;
  int width = 0;                // [px]
  int height = 0;               // [px]
  std::vector<uint8_t> labels;  // row-major; empty when the scene has none
};

// Truth of a scene.json; without frame, group and labels. Throws std::runtime_error on a key that
// is missing or of the wrong kind.
SceneTruth ParseSceneTruth(const nlohmann::json& scene);

std::string ScopeName(Scope scope);
std::string ShapeName(Shape shape);

}  // namespace declutter::accuracy
