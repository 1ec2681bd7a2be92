#include "modules/model_verifier/confidence.h"

#include <algorithm>

namespace declutter {
namespace {

constexpr double kUnexplainedReach = 0.020;  // [m] from a solid to points that it should explain
constexpr double kMinExtent = 0.010;         // [m] of a solid
constexpr double kUnknownWeight = 0.25;  // of a pixel without depth: dark or shiny, or no surface
constexpr double kAssumedDepthFactor = 0.75;  // of the confidence where only one side face was seen

}  // namespace

int NumUnexplained(const Solid& solid, const DepthImage& image, const Plane& support,
                   const std::vector<uint8_t>& labels) {
  const PixelWindow window = ProjectionWindow(solid, kUnexplainedReach, image.camera);
  const SolidCaster caster(solid);
  int num = 0;
  for (int v = window.v_begin; v < window.v_end; ++v) {
    for (int u = window.u_begin; u < window.u_end; ++u) {
      const double z = image.DepthAt(u, v);
      if (z <= 0 || labels[static_cast<size_t>(v * image.camera.width + u)] != 0) continue;
      const Eigen::Vector3d p_C = image.camera.Ray(u, v) * z;
      num += caster.SignedDistance(caster.X_OC() * p_C) < kUnexplainedReach &&
             support.Height(p_C) > 1.5 * SurfaceTolerance(z);
    }
  }
  return num;
}

double Confidence(const ObjectModel& object, const RayEvidence& evidence, int num_unexplained) {
  if (object.solid.size.minCoeff() < kMinExtent) return 0;
  double fit = 0;
  for (const auto& pixel : evidence.explained) fit += pixel.fit;
  if (object.evidence[1] == Evidence::kAssumed) fit *= kAssumedDepthFactor;
  const auto num_explained = static_cast<double>(evidence.explained.size());
  return fit / std::max(1.0, num_explained + evidence.num_violating + evidence.num_contradicting +
                                 num_unexplained + kUnknownWeight * evidence.num_unknown);
}

}  // namespace declutter
