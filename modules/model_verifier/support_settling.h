#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// Settles objects frame by frame, with memory that is used again.
class SupportSettler {
 public:
  // Extends solids whose lower end nobody saw (evidence[2] is kAssumed) down to what they stand on,
  // lifts any end that was proposed to be inside it, and sets what each stands on: the object
  // below, or the support plane. Sorts the objects by the height of their tops; supported_by counts
  // from 1 in that order.
  void Settle(const Observation& observation, std::vector<ObjectModel>* objects);

  // [m] by which the last call has extended each object, in their order; less than 0: lifted.
  const std::vector<double>& growth() const { return growth_; }

 private:
  // What an object could stand on.
  struct Floor {
    double height = 0;         // [m] above the support plane
    int32_t supported_by = 0;  // id of the object below, 0: the support plane
  };

  // Makes floors_ those below the bottom of a solid, or that it is sunk in. An object under much of
  // its footprint hides all lower ones.
  void FindFloorsBelow(const std::vector<ObjectModel>& objects, size_t index, double bottom,
                       const Observation& observation);
  bool IsSunkIn(const Solid& lower, const Solid& upper, const Observation& observation);
  const Floor& LowestFloor(const Solid& solid, double bottom, const Observation& observation);

  std::vector<Floor> floors_;  // lowest first
  std::vector<double> growth_;
  RayEvidence seen_;
};

// True for a solid whose z axis is the support normal.
bool IsUpright(const Solid& solid, const Plane& support);

// [m] of the highest and the lowest point of a solid above the support plane.
double TopOf(const Solid& solid, const Plane& support);
double BottomOf(const Solid& solid, const Plane& support);

// True for a solid of which at least what can be grasped is below a height [m] over the support
// plane, and as much above it.
bool ReachesThrough(const Solid& solid, double height, const Plane& support);

// A solid lengthened along its z axis down to the support plane.
Solid ExtendedToSupport(const Solid& solid, const Plane& support);

}  // namespace declutter
