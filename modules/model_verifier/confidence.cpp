#include "modules/model_verifier/confidence.h"

#include <algorithm>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/support_settling.h"

namespace declutter {
namespace {

constexpr double kUnexplainedReach = 0.020;  // [m] from a solid to points that it should explain
constexpr double kReachAbove = 0.050;        // [m] above a top that is not seen, the same
constexpr double kMinThickness = 0.010;      // [m] of a solid
constexpr double kMinHeightInSigmas = 4;     // of the noise: the support is seen in waves
constexpr double kUnknownWeight = 0.25;  // of a pixel without depth: dark or shiny, or no surface
constexpr double kAssumedDepthFactor = 0.75;  // of the confidence where only one side face was seen

}  // namespace

int NumUnexplained(const Solid& solid, bool is_top_seen, const Observation& unexplained) {
  return NumNear(is_top_seen ? solid : Longer(solid, 2, 1, kReachAbove), kUnexplainedReach,
                 unexplained);
}

double Confidence(const ObjectModel& object, const RayEvidence& evidence, int num_unexplained,
                  const Plane& support) {
  const Solid& solid = object.solid;
  if (solid.size.minCoeff() < kMinThickness ||
      TopOf(solid, support) - BottomOf(solid, support) <
          kMinHeightInSigmas * MeasurementSigma(solid.X_CO.translation().z())) {
    return 0;
  }
  double fit = evidence.Fit();
  if (object.evidence[1] == Evidence::kAssumed) fit *= kAssumedDepthFactor;
  const auto num_explained = static_cast<double>(evidence.explained.size());
  return fit / std::max(1.0, num_explained + evidence.num_violating + evidence.num_contradicting +
                                 num_unexplained + kUnknownWeight * evidence.num_unknown);
}

}  // namespace declutter
