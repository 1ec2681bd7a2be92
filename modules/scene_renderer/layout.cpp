#include "modules/scene_renderer/layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace declutter {
namespace {

// Faces that touch may differ by rounding of the scene text.
constexpr double kOverlapTolerance_m = 1e-6;

PlacedObject PlaceObject(const SceneObject& stated, int index,
                         const std::vector<PlacedObject>& before) {
  PlacedObject object;
  if (stated.has_box()) {
    object.footprint.half = {0.5 * stated.box().size_x_m(), 0.5 * stated.box().size_y_m()};
    object.height_m = stated.box().size_z_m();
  } else if (stated.has_cylinder()) {
    object.shape = Shape::kCylinder;
    object.footprint.round = true;
    object.footprint.half.setConstant(stated.cylinder().radius_m());
    object.height_m = stated.cylinder().height_m();
  } else {
    throw ObjectFault(index, "is neither a box nor a cylinder");
  }
  object.footprint.centre = {stated.x_m(), stated.y_m()};
  object.footprint.yaw_rad = stated.yaw_rad();
  object.bottom_m = stated.support_height_m();
  if (stated.has_on()) {
    if (stated.on() < 0 || stated.on() >= static_cast<int>(before.size())) {
      throw ObjectFault(index, "stands on object " + std::to_string(stated.on()) +
                                   ", which is not listed before it");
    }
    object.on = stated.on();
    const PlacedObject& support = before[static_cast<size_t>(object.on)];
    object.bottom_m = support.bottom_m + support.height_m;
  }
  object.color = PaletteColor(index);
  if (stated.has_color()) {
    object.color = {stated.color().r(), stated.color().g(), stated.color().b()};
  }
  return object;
}

}  // namespace

PinholeCamera CameraOf(const SceneCamera& camera) {
  return {camera.width(), camera.height(), camera.fx(), camera.fy(), camera.cx(), camera.cy()};
}

Eigen::Isometry3d CameraPose(const SceneCamera& camera) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  if (camera.has_pose()) {
    const ScenePose& pose = camera.pose();
    const Eigen::Quaterniond q(pose.qw(), pose.qx(), pose.qy(), pose.qz());
    if (std::abs(q.norm() - 1) > 1e-3) {
      throw std::invalid_argument("camera.pose: the quaternion's length is not 1");
    }
    X_WC.linear() = q.normalized().toRotationMatrix();
    X_WC.translation() = Eigen::Vector3d(pose.x_m(), pose.y_m(), pose.z_m());
    return X_WC;
  }
  const double c = std::cos(camera.pitch_rad()), s = std::sin(camera.pitch_rad());
  Eigen::Matrix3d R_WC;  // columns: right, down and forward of the camera
  R_WC << 1, 0, 0,       //
      0, -s, c,          //
      0, -c, -s;
  X_WC.linear() =
      R_WC * Eigen::AngleAxisd(camera.roll_rad(), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X_WC.translation() = Eigen::Vector3d(0, 0, camera.height_m());
  return X_WC;
}

std::vector<PlacedObject> PlaceObjects(const Scene& scene) {
  std::vector<PlacedObject> objects;
  for (const SceneObject& stated : scene.object()) {
    const int index = static_cast<int>(objects.size());
    const PlacedObject object = PlaceObject(stated, index, objects);
    for (size_t other = 0; other < objects.size(); ++other) {
      const double gap_m = Gap(objects[other].footprint, object.footprint);
      if (ShareHeights(objects[other], object) && gap_m < -kOverlapTolerance_m) {
        throw ObjectFault(index, "cuts " + std::to_string(-1000 * gap_m) + " mm into object " +
                                     std::to_string(other));
      }
    }
    objects.push_back(object);
  }
  return objects;
}

SceneObject ToSceneObject(const PlacedObject& object) {
  SceneObject stated;
  if (object.shape == Shape::kBox) {
    stated.mutable_box()->set_size_x_m(2 * object.footprint.half.x());
    stated.mutable_box()->set_size_y_m(2 * object.footprint.half.y());
    stated.mutable_box()->set_size_z_m(object.height_m);
  } else {
    stated.mutable_cylinder()->set_radius_m(object.footprint.half.x());
    stated.mutable_cylinder()->set_height_m(object.height_m);
  }
  stated.set_x_m(object.footprint.centre.x());
  stated.set_y_m(object.footprint.centre.y());
  stated.set_yaw_rad(object.footprint.yaw_rad);
  if (object.on >= 0) {
    stated.set_on(object.on);
  } else if (object.bottom_m > 0) {
    stated.set_support_height_m(object.bottom_m);
  }
  stated.mutable_color()->set_r(object.color.x());
  stated.mutable_color()->set_g(object.color.y());
  stated.mutable_color()->set_b(object.color.z());
  return stated;
}

Solid ToSolid(const PlacedObject& object, const Eigen::Isometry3d& X_CW) {
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  X_WO.translation() << object.footprint.centre, object.bottom_m + 0.5 * object.height_m;
  X_WO.linear() =
      Eigen::AngleAxisd(object.footprint.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  Solid solid;
  solid.shape = object.shape;
  solid.X_CO = X_CW * X_WO;
  solid.size << 2 * object.footprint.half, object.height_m;
  return solid;
}

bool ShareHeights(const PlacedObject& a, const PlacedObject& b) {
  return a.bottom_m + a.height_m > b.bottom_m + kOverlapTolerance_m &&
         b.bottom_m + b.height_m > a.bottom_m + kOverlapTolerance_m;
}

Eigen::Vector3d PaletteColor(int index) {
  static const std::array<Eigen::Vector3d, 12> kPalette = {{{0.80, 0.16, 0.14},
                                                            {0.95, 0.78, 0.16},
                                                            {0.13, 0.38, 0.70},
                                                            {0.24, 0.58, 0.25},
                                                            {0.90, 0.48, 0.12},
                                                            {0.86, 0.84, 0.80},
                                                            {0.48, 0.22, 0.55},
                                                            {0.16, 0.60, 0.66},
                                                            {0.55, 0.35, 0.20},
                                                            {0.88, 0.45, 0.60},
                                                            {0.30, 0.32, 0.36},
                                                            {0.62, 0.76, 0.25}}};
  return kPalette[static_cast<size_t>(index) % kPalette.size()];
}

}  // namespace declutter
