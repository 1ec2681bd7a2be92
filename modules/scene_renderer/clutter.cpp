#include "modules/scene_renderer/clutter.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "modules/scene_renderer/placement.h"
#include "modules/scene_renderer/ray_caster.h"

namespace declutter {
namespace {

constexpr double kTouchingGap_m = 0.001;
// The search counts every 4th pixel along u and v and keeps this much in reserve.
constexpr int kSearchStep = 4;
constexpr double kReserve = 1.2;
// Tries to find a free place before a move is given up.
constexpr int kTries = 40;
// Chance to keep a layout that is a little worse, which gets the search out of corners.
constexpr double kChanceOfWorse = 0.02;

PinholeCamera EveryNth(const PinholeCamera& camera, int step) {
  const double n = step;
  return {camera.width / step, camera.height / step,        camera.fx / n,
          camera.fy / n,       (camera.cx + 0.5) / n - 0.5, (camera.cy + 0.5) / n - 0.5};
}

double NearestGap(const std::vector<PlacedObject>& objects, size_t index) {
  double nearest = 1e3;
  for (size_t other = 0; other < objects.size(); ++other) {
    if (other == index || !ShareHeights(objects[index], objects[other])) continue;
    nearest = std::min(nearest, Gap(objects[index].footprint, objects[other].footprint));
  }
  return nearest;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// How far a layout is from the limits; 0: it keeps them.
double Excess(const SceneClutter& clutter, const ClutterFigures& figures, double reserve) {
  double excess = std::max(0, clutter.min_touching_pairs() - figures.num_touching_pairs) +
                  std::max(0, clutter.min_half_hidden() - figures.num_half_hidden);
  const double limit_m = std::max(1e-4, clutter.max_median_gap_m());
  excess += 2 * std::max(0.0, figures.median_gap_m / limit_m - 1);
  const double min_px = reserve * clutter.min_visible_px();
  for (const int visible : figures.visible_px) {
    if (visible < min_px) excess += 0.3 + 2 * (1 - visible / min_px);
  }
  return excess;
}

std::string Describe(const SceneClutter& clutter, const ClutterFigures& figures) {
  const auto fewest = std::min_element(figures.visible_px.begin(), figures.visible_px.end());
  return std::to_string(figures.num_touching_pairs) + " of " +
         std::to_string(clutter.min_touching_pairs()) + " touching pairs, " +
         std::to_string(figures.num_half_hidden) + " of " +
         std::to_string(clutter.min_half_hidden()) +
         " objects less than half visible, median gap " +
         std::to_string(1000 * figures.median_gap_m) + " mm, fewest visible pixels " +
         std::to_string(fewest == figures.visible_px.end() ? 0 : *fewest);
}

// A layout on its way to the limits. The last num_stacked objects stand on others.
class Search {
 public:
  Search(const Scene& scene, uint64_t seed, const std::vector<PlacedObject>& fixed)
      : scene_(scene), objects_(fixed), placement_(scene, seed), num_fixed_(fixed.size()) {}

  std::vector<PlacedObject> Run() {
    Start();
    ClutterFigures figures = Measure(scene_, objects_, kSearchStep);
    double excess = Excess(scene_.clutter(), figures, kReserve);
    for (int move = 0; move < scene_.clutter().max_moves(); ++move) {
      if (excess == 0 && Excess(scene_.clutter(), Measure(scene_, objects_), 1) == 0) {
        return objects_;
      }
      const std::vector<PlacedObject> before = objects_;
      if (!Move(figures)) continue;
      const ClutterFigures moved = Measure(scene_, objects_, kSearchStep);
      const double moved_excess = Excess(scene_.clutter(), moved, kReserve);
      if (moved_excess <= excess || placement_.Chance(kChanceOfWorse)) {
        figures = moved;
        excess = moved_excess;
      } else {
        objects_ = before;
      }
    }
    throw std::invalid_argument("clutter not reached in " +
                                std::to_string(scene_.clutter().max_moves()) +
                                " moves: " + Describe(scene_.clutter(), Measure(scene_, objects_)));
  }

 private:
  void Start() {
    const SceneClutter& clutter = scene_.clutter();
    std::vector<Shape> shapes(static_cast<size_t>(clutter.num_boxes()), Shape::kBox);
    shapes.resize(shapes.size() + static_cast<size_t>(clutter.num_cylinders()), Shape::kCylinder);
    placement_.Shuffle(&shapes);
    const size_t num_stacked = static_cast<size_t>(clutter.num_stacked());
    if (num_stacked >= shapes.size() + num_fixed_ && num_stacked > 0) {
      throw std::invalid_argument("clutter: num_stacked leaves no object on the table");
    }
    num_standing_ = num_fixed_ + shapes.size() - std::min(num_stacked, shapes.size());
    for (const Shape shape : shapes) Add(shape);
  }

  void Add(Shape shape) {
    const int index = static_cast<int>(objects_.size());
    for (int i = 0; i < scene_.clutter().max_moves(); ++i) {
      if (std::optional<PlacedObject> object = Find(shape, objects_.size(), objects_)) {
        object->color = PaletteColor(index);
        objects_.push_back(*object);
        return;
      }
    }
    throw std::invalid_argument("clutter: no room for object " + std::to_string(index));
  }

  std::optional<PlacedObject> Find(Shape shape, size_t index,
                                   const std::vector<PlacedObject>& others) {
    for (int i = 0; i < kTries; ++i) {
      const std::optional<PlacedObject> object = index < num_standing_
                                                     ? placement_.BesideAnother(shape, others)
                                                     : placement_.OnAnother(shape, others);
      if (object) return object;
    }
    return std::nullopt;
  }

  // Takes one object away, with what stands on it, and puts them down elsewhere.
  bool Move(const ClutterFigures& figures) {
    if (objects_.size() == num_fixed_) return false;
    const size_t moved = Choose(figures);
    const std::vector<PlacedObject> before = objects_;
    for (size_t i = moved; i < objects_.size(); ++i) {
      if (i != moved && before[i].on != static_cast<int>(moved)) continue;
      std::vector<PlacedObject> others = objects_;
      // What is taken away must not be in the way: it is put out of reach.
      for (size_t k = 0; k < others.size(); ++k) {
        if (k == i || (k > i && before[k].on == static_cast<int>(moved))) others[k].height_m = 0;
      }
      const std::optional<PlacedObject> object = Find(objects_[i].shape, i, others);
      if (!object) {
        objects_ = before;
        return false;
      }
      const Eigen::Vector3d color = objects_[i].color;
      objects_[i] = *object;
      objects_[i].color = color;
    }
    return true;
  }

  // Mostly one that is too well hidden, or else any.
  size_t Choose(const ClutterFigures& figures) {
    std::vector<size_t> candidates;
    for (size_t i = num_fixed_; i < objects_.size(); ++i) {
      if (figures.visible_px[i] < kReserve * scene_.clutter().min_visible_px()) {
        candidates.push_back(i);
      }
    }
    if (!candidates.empty() && placement_.Chance(0.6)) {
      return candidates[placement_.Index(candidates.size())];
    }
    return num_fixed_ + placement_.Index(objects_.size() - num_fixed_);
  }

  const Scene& scene_;
  std::vector<PlacedObject> objects_;
  Placement placement_;
  size_t num_fixed_;
  size_t num_standing_ = 0;
};

}  // namespace

ClutterFigures Measure(const Scene& scene, const std::vector<PlacedObject>& objects, int step) {
  ClutterFigures figures;
  const Eigen::Isometry3d X_CW = CameraPose(scene.camera()).inverse();
  std::vector<Solid> solids;
  for (const PlacedObject& object : objects) solids.push_back(ToSolid(object, X_CW));
  const IdealImage ideal = CastRays(EveryNth(CameraOf(scene.camera()), step), solids);
  figures.visible_px.assign(objects.size(), 0);
  for (const int16_t solid : ideal.solid) {
    if (solid >= 0) figures.visible_px[static_cast<size_t>(solid)] += step * step;
  }
  std::vector<double> gaps_m;
  for (size_t i = 0; i < objects.size(); ++i) {
    gaps_m.push_back(NearestGap(objects, i));
    figures.num_stacked += objects[i].on >= 0 ? 1 : 0;
    const int unoccluded = ideal.num_covered[i] * step * step;
    figures.num_half_hidden += 2 * figures.visible_px[i] < unoccluded ? 1 : 0;
    for (size_t other = 0; other < i; ++other) {
      const bool touching = ShareHeights(objects[i], objects[other]) &&
                            Gap(objects[i].footprint, objects[other].footprint) <= kTouchingGap_m;
      figures.num_touching_pairs += touching ? 1 : 0;
    }
  }
  figures.median_gap_m = Median(gaps_m);
  return figures;
}

std::vector<PlacedObject> AddClutter(const Scene& scene, uint64_t seed,
                                     const std::vector<PlacedObject>& fixed) {
  return Search(scene, seed, fixed).Run();
}

}  // namespace declutter
