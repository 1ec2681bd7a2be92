#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "modules/scene_renderer/layout.h"
#include "modules/scene_renderer/scene.pb.h"

namespace declutter {

// Draws household objects and free places for them from one random stream. Objects of height 0 are
// treated as absent.
class Placement {
 public:
  Placement(const Scene& scene, uint64_t seed);

  // A new object on the table, touching an object that is there or a small gap away from it;
  // near the middle of the clutter when there is none. Nothing when the place is taken, outside
  // of the clutter's area or of the image.
  std::optional<PlacedObject> BesideAnother(Shape shape, const std::vector<PlacedObject>& others);

  // A new object wholly on the top of one that stands on the table and carries nothing else.
  std::optional<PlacedObject> OnAnother(Shape shape, const std::vector<PlacedObject>& others);

  bool Chance(double probability) { return Uniform(0, 1) < probability; }
  // One of 0 .. count - 1.
  size_t Index(size_t count) {
    return std::uniform_int_distribution<size_t>(0, count - 1)(random_);
  }
  void Shuffle(std::vector<Shape>* shapes) {
    std::shuffle(shapes->begin(), shapes->end(), random_);
  }

 private:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, std::max(low, high))(random_);
  }
  PlacedObject Draw(Shape shape);
  PlacedObject DrawBox();
  PlacedObject DrawCylinder();
  void PutFlush(const Footprint& neighbour, double gap_m, Footprint* footprint);
  void SlideTowards(const Footprint& neighbour, double gap_m, Footprint* footprint);
  bool IsFree(const PlacedObject& object, const std::vector<PlacedObject>& others) const;

  const Scene scene_;
  const PinholeCamera camera_;
  const Eigen::Isometry3d X_CW_;
  std::mt19937_64 random_;
};

}  // namespace declutter
