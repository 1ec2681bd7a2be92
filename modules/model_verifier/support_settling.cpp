#include "modules/model_verifier/support_settling.h"

#include <algorithm>
#include <cmath>

#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {
namespace {

constexpr double kSupportTolerance = 0.012;  // [m] between a bottom and the top it stands on
constexpr double kMinFootprint = 0.05;       // share over an object that can carry the upper one
constexpr double kFullFootprint = 0.30;      // share over an object that must carry it
constexpr double kCentralFootprint = 0.50;   // share over an object that it cannot fall off
constexpr double kMaxNewViolating = 0.1;     // of the explained pixels, by extending a solid down
constexpr double kMaxNewExplained = 0.2;     // of those, by the part that is inside another solid

// [m] half the vertical extent of a solid in any pose.
double HalfExtent(const Solid& solid, const Plane& support) {
  const Eigen::Vector3d up_O = solid.X_CO.linear().transpose() * support.normal;
  if (solid.shape == Shape::kBox) return 0.5 * up_O.cwiseAbs().dot(solid.size);
  return 0.5 * std::abs(up_O.z()) * solid.height() + up_O.head<2>().norm() * solid.radius();
}

// Share of the upper solid's footprint that lies over the lower solid.
double FootprintOver(const Solid& upper, const Solid& lower) {
  constexpr int kSteps = 5;
  const SolidCaster caster(lower);
  const Eigen::Vector3d axis_C = upper.X_CO.linear().col(2);
  int num_over = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Eigen::Vector3d p_O((0.9 * (i + 0.5) / kSteps - 0.45) * upper.size.x(),
                                (0.9 * (j + 0.5) / kSteps - 0.45) * upper.size.y(), 0);
      const Eigen::Vector3d p_C = upper.X_CO * p_O;
      const double height = axis_C.dot(p_C - lower.X_CO.translation());
      num_over += caster.SignedDistance(caster.X_OC() * (p_C - height * axis_C)) < 0;
    }
  }
  return static_cast<double>(num_over) / (kSteps * kSteps);
}

}  // namespace

bool IsUpright(const Solid& solid, const Plane& support) {
  return solid.X_CO.linear().col(2).dot(support.normal) > 0.99;
}

double TopOf(const Solid& solid, const Plane& support) {
  return support.Height(solid.X_CO.translation()) + HalfExtent(solid, support);
}

double BottomOf(const Solid& solid, const Plane& support) {
  return support.Height(solid.X_CO.translation()) - HalfExtent(solid, support);
}

bool ReachesThrough(const Solid& solid, double height, const Plane& support) {
  return TopOf(solid, support) >= height + kMinExtent &&
         BottomOf(solid, support) <= height - kMinExtent;
}

Solid ExtendedToSupport(const Solid& solid, const Plane& support) {
  return Longer(solid, 2, -1, BottomOf(solid, support));
}

// True for a solid that was proposed to end inside what carries it: below the top of that one it
// would explain little. Not where both have one outline, and so one side.
bool SupportSettler::IsSunkIn(const Solid& lower, const Solid& upper,
                              const Observation& observation) {
  const Plane& support = observation.support;
  const double bottom = BottomOf(upper, support), floor = TopOf(lower, support);
  if (!IsUpright(upper, support) || TopOf(upper, support) < floor + kMinExtent) return false;
  const auto num_explained = [&](const Solid& solid) {
    CastRays(solid, observation, &seen_);
    return seen_.num_explained();
  };
  return num_explained(ExtendedToSupport(upper, support)) <
         (1 + kMaxNewExplained) * num_explained(Longer(upper, 2, -1, bottom - floor));
}

void SupportSettler::FindFloorsBelow(const std::vector<ObjectModel>& objects, size_t index,
                                     double bottom, const Observation& observation) {
  const ObjectModel& upper = objects[index];
  floors_.assign(1, Floor());
  for (size_t j = 0; j < index; ++j) {
    const double top = TopOf(objects[j].solid, observation.support);
    const double share = FootprintOver(upper.solid, objects[j].solid);
    if (share < kMinFootprint) continue;
    if (top > bottom + kSupportTolerance &&
        !(share > kCentralFootprint && IsSunkIn(objects[j].solid, upper.solid, observation))) {
      continue;
    }
    if (share > kFullFootprint) {
      floors_.erase(std::remove_if(floors_.begin(), floors_.end(),
                                   [top](const Floor& floor) { return floor.height < top; }),
                    floors_.end());
    }
    const auto above = std::find_if(floors_.begin(), floors_.end(),
                                    [top](const Floor& floor) { return floor.height > top; });
    floors_.insert(above, {top, static_cast<int32_t>(j + 1)});
  }
}

// The lowest of floors_ that a solid may reach down to without taking much free space.
const SupportSettler::Floor& SupportSettler::LowestFloor(const Solid& solid, double bottom,
                                                         const Observation& observation) {
  CastRays(solid, observation, &seen_);
  const double max_violating = seen_.num_violating + kMaxNewViolating * seen_.num_explained();
  for (const Floor& floor : floors_) {
    if (&floor == &floors_.back()) break;
    CastRays(Longer(solid, 2, -1, bottom - floor.height), observation, &seen_);
    if (seen_.num_violating <= max_violating) return floor;
  }
  return floors_.back();
}

void SupportSettler::Settle(const Observation& observation, std::vector<ObjectModel>* objects) {
  const Plane& support = observation.support;
  std::sort(objects->begin(), objects->end(), [&](const ObjectModel& a, const ObjectModel& b) {
    return TopOf(a.solid, support) < TopOf(b.solid, support);
  });
  growth_.assign(objects->size(), 0);
  for (size_t i = 0; i < objects->size(); ++i) {
    ObjectModel& upper = (*objects)[i];
    const double bottom = BottomOf(upper.solid, support);
    FindFloorsBelow(*objects, i, bottom, observation);
    const bool was_seen = upper.evidence[2] != Evidence::kAssumed;
    const Floor& floor = was_seen ? floors_.back() : LowestFloor(upper.solid, bottom, observation);
    upper.supported_by = floor.supported_by;
    if (was_seen && floor.height <= bottom + kSupportTolerance) continue;
    growth_[i] = bottom - floor.height;
    upper.solid = Longer(upper.solid, 2, -1, growth_[i]);
  }
}

}  // namespace declutter
