#include "modules/model_verifier/support_settling.h"

#include <algorithm>

#include "modules/model_verifier/ray_casting.h"

namespace declutter {
namespace {

constexpr double kSupportTolerance = 0.012;  // [m] between a bottom and the top it stands on

// Heights of the ends of a solid above the support plane [m].
double Bottom(const Solid& solid, const Plane& support) {
  return support.Height(solid.X_CO.translation()) - 0.5 * solid.height();
}
double Top(const Solid& solid, const Plane& support) {
  return support.Height(solid.X_CO.translation()) + 0.5 * solid.height();
}

// True when the middle part of the upper solid's footprint lies over the lower solid.
bool IsOver(const Solid& upper, const Solid& lower) {
  const SolidCaster caster(lower);
  int num_over = 0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const Eigen::Vector3d p_O(0.3 * i * upper.size.x(), 0.3 * j * upper.size.y(), 0);
      const Eigen::Vector3d axis_C = upper.X_CO.linear().col(2);
      const Eigen::Vector3d p_C = upper.X_CO * p_O;
      const Eigen::Vector3d in_lower = p_C - axis_C * axis_C.dot(p_C - lower.X_CO.translation());
      num_over += caster.SignedDistance(in_lower) < 0;
    }
  }
  return num_over >= 3;
}

}  // namespace

void SettleOnSupports(const Plane& support, std::vector<ObjectModel>* objects) {
  std::stable_sort(objects->begin(), objects->end(),
                   [&](const ObjectModel& a, const ObjectModel& b) {
                     return Top(a.solid, support) < Top(b.solid, support);
                   });
  for (size_t i = 0; i < objects->size(); ++i) {
    ObjectModel& upper = (*objects)[i];
    const double bottom = Bottom(upper.solid, support);
    double floor = 0;
    for (size_t j = 0; j < i; ++j) {
      const ObjectModel& lower = (*objects)[j];
      const double top = Top(lower.solid, support);
      if (top > floor && top < bottom + kSupportTolerance && IsOver(upper.solid, lower.solid)) {
        floor = top;
        upper.supported_by = static_cast<int32_t>(j + 1);
      }
    }
    if (upper.evidence[2] != Evidence::kAssumed) continue;
    const double change = bottom - floor;
    upper.solid.size.z() += change;
    upper.solid.X_CO.translation() -= 0.5 * change * upper.solid.X_CO.linear().col(2);
  }
}

}  // namespace declutter
