#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <stdexcept>
#include <string>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/scene_renderer/footprint.h"
#include "modules/scene_renderer/scene.pb.h"

namespace declutter {

// An object put down in W.
struct PlacedObject {
  Shape shape = Shape::kBox;
  Footprint footprint;
  double bottom_m = 0;  // height of its lower face above the table
  double height_m = 0;
  int on = -1;                              // object it stands on; -1: the table
  Eigen::Vector3d color = {0.6, 0.6, 0.6};  // base colour, 0..1
};

// Why an object of a scene cannot be put down.
class ObjectFault : public std::invalid_argument {
 public:
  ObjectFault(int object, const std::string& what)
      : std::invalid_argument("object " + std::to_string(object) + " " + what), object_(object) {}
  int object() const { return object_; }  // counted from 0

 private:
  int object_;
};

PinholeCamera CameraOf(const SceneCamera& camera);

// Pose X_WC. Throws std::invalid_argument for a quaternion that is no rotation.
Eigen::Isometry3d CameraPose(const SceneCamera& camera);

// The objects a scene states, colours filled in. Throws ObjectFault when one has no shape, stands
// on one that is not listed before it, or cuts into another.
std::vector<PlacedObject> PlaceObjects(const Scene& scene);

// The same objects as scene text would state them.
SceneObject ToSceneObject(const PlacedObject& object);

// The object as a solid of C.
Solid ToSolid(const PlacedObject& object, const Eigen::Isometry3d& X_CW);

// Whether the objects share heights, so that their footprints must not overlap.
bool ShareHeights(const PlacedObject& a, const PlacedObject& b);

// Base colour of the object of an index: printed cardboard and tins.
Eigen::Vector3d PaletteColor(int index);

}  // namespace declutter
