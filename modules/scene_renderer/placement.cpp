#include "modules/scene_renderer/placement.h"

#include <array>
#include <cmath>

namespace declutter {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Objects put side by side keep this gap, so that rounding never makes them overlap.
constexpr double kTouch_m = 0.0003;
constexpr double kChanceToTouch = 0.5;
constexpr double kChanceOfFlush = 0.5;
constexpr double kChanceOfTin = 1.0 / 6;
// What stands by itself without falling over when it is pushed: height against the shorter side
// of the footprint.
constexpr double kMaxSlenderness = 5;
// Shortest side of a box against its longest.
constexpr double kMinBoxProportion = 0.2;
constexpr double kMaxTinHeight_m = 0.12;
// [px] that objects keep from the image's border.
constexpr double kBorder_px = 6;
// [m] that a stacked object keeps from the edge below it.
constexpr double kLedge_m = 0.003;

}  // namespace

Placement::Placement(const Scene& scene, uint64_t seed)
    : scene_(scene),
      camera_(CameraOf(scene.camera())),
      X_CW_(CameraPose(scene.camera()).inverse()),
      random_(seed) {}

std::optional<PlacedObject> Placement::BesideAnother(Shape shape,
                                                     const std::vector<PlacedObject>& others) {
  PlacedObject object = Draw(shape);
  std::vector<size_t> neighbours;
  for (size_t i = 0; i < others.size(); ++i) {
    if (others[i].height_m > 0 && others[i].bottom_m == 0) neighbours.push_back(i);
  }
  if (neighbours.empty()) {
    object.footprint.centre = {scene_.clutter().x_m(), scene_.clutter().y_m()};
  } else {
    const Footprint& neighbour = others[neighbours[Index(neighbours.size())]].footprint;
    const double gap_m = Chance(kChanceToTouch)
                             ? kTouch_m
                             : Uniform(scene_.clutter().min_gap_m(), scene_.clutter().max_gap_m());
    if (!neighbour.round && !object.footprint.round && Chance(kChanceOfFlush)) {
      PutFlush(neighbour, gap_m, &object.footprint);
    } else {
      SlideTowards(neighbour, gap_m, &object.footprint);
    }
  }
  if (!IsFree(object, others)) return std::nullopt;
  return object;
}

std::optional<PlacedObject> Placement::OnAnother(Shape shape,
                                                 const std::vector<PlacedObject>& others) {
  PlacedObject object = Draw(shape);
  std::vector<size_t> supports;
  for (size_t i = 0; i < others.size(); ++i) {
    const auto carried = [i](const PlacedObject& other) {
      return other.height_m > 0 && other.on == static_cast<int>(i);
    };
    if (others[i].height_m > 0 && others[i].on < 0 &&
        std::none_of(others.begin(), others.end(), carried)) {
      supports.push_back(i);
    }
  }
  if (supports.empty()) return std::nullopt;
  object.on = static_cast<int>(supports[Index(supports.size())]);
  const PlacedObject& support = others[static_cast<size_t>(object.on)];
  object.bottom_m = support.bottom_m + support.height_m;
  const Vector2d half = HalfBounds(support.footprint);
  object.footprint.centre = support.footprint.centre +
                            Vector2d(Uniform(-half.x(), half.x()), Uniform(-half.y(), half.y()));
  if (!Contains(support.footprint, object.footprint, kLedge_m)) return std::nullopt;
  if (!IsFree(object, others)) return std::nullopt;
  return object;
}

PlacedObject Placement::Draw(Shape shape) {
  PlacedObject object = shape == Shape::kBox ? DrawBox() : DrawCylinder();
  object.shape = shape;
  return object;
}

PlacedObject Placement::DrawBox() {
  const SceneClutter& clutter = scene_.clutter();
  std::array<double, 3> sides{};
  do {
    sides[0] = Uniform(clutter.min_box_length_m(), clutter.max_box_length_m());
    const double widest = std::min(clutter.max_box_width_m(), sides[0]);
    const double narrowest = std::max(clutter.min_box_width_m(), kMinBoxProportion * sides[0]);
    sides[1] = Uniform(narrowest, widest);
    sides[2] = Uniform(narrowest, widest);
    std::shuffle(sides.begin(), sides.end(), random_);
  } while (sides[2] > kMaxSlenderness * std::min(sides[0], sides[1]));
  PlacedObject box;
  box.footprint.half = {0.5 * sides[0], 0.5 * sides[1]};
  box.footprint.yaw_rad = Uniform(-M_PI, M_PI);
  box.height_m = sides[2];
  return box;
}

PlacedObject Placement::DrawCylinder() {
  const SceneClutter& clutter = scene_.clutter();
  PlacedObject cylinder;
  const bool tin = clutter.max_tin_radius_m() > clutter.max_radius_m() && Chance(kChanceOfTin);
  const double radius = tin ? Uniform(clutter.max_radius_m(), clutter.max_tin_radius_m())
                            : Uniform(clutter.min_radius_m(), clutter.max_radius_m());
  const double tallest = std::min(clutter.max_cylinder_height_m(),
                                  tin ? kMaxTinHeight_m : 2 * radius * kMaxSlenderness);
  cylinder.footprint.round = true;
  cylinder.footprint.half.setConstant(radius);
  cylinder.height_m = Uniform(clutter.min_cylinder_height_m(), tallest);
  return cylinder;
}

// Face to face with a side of the neighbour, shifted along it.
void Placement::PutFlush(const Footprint& neighbour, double gap_m, Footprint* footprint) {
  const int axis = static_cast<int>(Index(2));
  const double side = Chance(0.5) ? 1 : -1;
  footprint->yaw_rad = std::remainder(neighbour.yaw_rad + (Chance(0.5) ? 0 : M_PI_2), 2 * M_PI);
  const bool turned = std::abs(std::cos(footprint->yaw_rad - neighbour.yaw_rad)) < 0.5;
  const Vector2d half =
      turned ? Vector2d(footprint->half.y(), footprint->half.x()) : footprint->half;
  const double reach = 0.7 * (neighbour.half[1 - axis] + half[1 - axis]);
  Vector2d offset;
  offset[axis] = side * (neighbour.half[axis] + half[axis] + gap_m);
  offset[1 - axis] = Uniform(-reach, reach);
  footprint->centre = neighbour.centre + Eigen::Rotation2Dd(neighbour.yaw_rad) * offset;
}

// As near as the gap allows, from a random side.
void Placement::SlideTowards(const Footprint& neighbour, double gap_m, Footprint* footprint) {
  const double heading = Uniform(-M_PI, M_PI);
  const Vector2d direction(std::cos(heading), std::sin(heading));
  double near = 0, far = neighbour.half.norm() + footprint->half.norm() + gap_m;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (near + far);
    footprint->centre = neighbour.centre + middle * direction;
    (Gap(neighbour, *footprint) < gap_m ? near : far) = middle;
  }
  footprint->centre = neighbour.centre + far * direction;
}

bool Placement::IsFree(const PlacedObject& object, const std::vector<PlacedObject>& others) const {
  const SceneClutter& clutter = scene_.clutter();
  const SceneTable& table = scene_.table();
  const Vector2d half = HalfBounds(object.footprint);
  const Vector2d centre = object.footprint.centre;
  const auto inside = [&](const Vector2d& middle, const Vector2d& extent) {
    return ((centre - middle).cwiseAbs() + half - 0.5 * extent).maxCoeff() <= 0;
  };
  if (!inside({clutter.x_m(), clutter.y_m()}, {clutter.extent_x_m(), clutter.extent_y_m()}) ||
      !inside({table.x_m(), table.y_m()}, {table.size_x_m(), table.size_y_m()})) {
    return false;
  }
  const Solid solid = ToSolid(object, X_CW_);
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1) ? 0.5 : -0.5, (corner & 2) ? 0.5 : -0.5,
                        (corner & 4) ? 0.5 : -0.5);
    const Vector3d p_C = solid.X_CO * sign.cwiseProduct(solid.size);
    if (p_C.z() < 0.1) return false;
    const Vector2d pixel = camera_.Project(p_C);
    if (pixel.minCoeff() < kBorder_px || pixel.x() > camera_.width - kBorder_px ||
        pixel.y() > camera_.height - kBorder_px) {
      return false;
    }
  }
  return std::none_of(others.begin(), others.end(), [&](const PlacedObject& other) {
    return other.height_m > 0 && ShareHeights(object, other) &&
           Gap(object.footprint, other.footprint) < 0.5 * kTouch_m;
  });
}

}  // namespace declutter
