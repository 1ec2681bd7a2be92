#include "modules/model_verifier/ray_casting.h"

#include <algorithm>
#include <cmath>

#include "modules/geometry/sensor_noise.h"

namespace declutter {
namespace {

constexpr double kMaxOverhang = 0.015;       // [m] beside a solid that its top face is looked for
constexpr double kMinTolerance = 0.005;      // [m] of points on a surface
constexpr double kToleranceInSigmas = 3;     // of points on a surface
constexpr double kSurfaceMinHeight = 0.8;    // [tolerances] of points of objects
constexpr double kNeighbourMinHeight = 1.5;  // [tolerances] of points that need an explanation

// min_height: in tolerances, of points that are no part of the support plane.
RayLimits LimitsWith(double min_height) {
  RayLimits limits;
  limits.min_tolerance_m = static_cast<float>(kMinTolerance);
  limits.tolerance_per_square = static_cast<float>(kToleranceInSigmas * kSigmaPerSquaredDepth);
  limits.min_height_in_tolerances = static_cast<float>(min_height);
  limits.edge_margin_m = 0.012f;
  limits.max_overhang_m = static_cast<float>(kMaxOverhang);
  limits.top_tolerance_m = 0.004f;
  limits.min_normal_cos = 0.85f;  // 32 degrees
  return limits;
}

// Drops what is explained but belongs to others.
void DropOfOthers(const Observation& observation, RayCounts* counts) {
  if (observation.owners == nullptr) return;
  int num_kept = 0;
  for (int i = 0; i < counts->num_explained; ++i) {
    const int32_t pixel = counts->explained[i];
    const uint8_t owner = (*observation.owners)[static_cast<size_t>(pixel)];
    if (owner != 0 && owner != observation.owner) {
      counts->fit -= counts->fits[i];
      continue;
    }
    counts->explained[num_kept] = pixel;
    counts->fits[num_kept++] = counts->fits[i];
  }
  counts->num_explained = num_kept;
}

}  // namespace

SolidCaster::SolidCaster(const Solid& solid)
    : shape_(solid.shape), half_size_(0.5 * solid.size), X_OC_(solid.X_CO.inverse()) {}

double SolidCaster::SignedDistance(const Eigen::Vector3d& p) const {
  if (shape_ == Shape::kBox) {
    const Eigen::Vector3d q = p.cwiseAbs() - half_size_;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
  }
  const Eigen::Vector2d q(p.head<2>().norm() - half_size_.x(), std::abs(p.z()) - half_size_.z());
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

RayEvidence CastRays(const Solid& solid, const Observation& observation) {
  RayEvidence evidence;
  CastRays(solid, observation, &evidence);
  return evidence;
}

void CastRays(const Solid& solid, const Observation& observation, RayEvidence* replaced) {
  static const RayLimits kLimits = LimitsWith(kSurfaceMinHeight);
  RayEvidence& evidence = *replaced;
  const RayWindow window = WindowOf(solid, kMaxOverhang, observation);
  const auto room = static_cast<size_t>(window.u_end - window.u_begin) *
                        static_cast<size_t>(window.v_end - window.v_begin) +
                    kRayPadding;
  for (auto* list :
       {&evidence.explained, &evidence.fits, &evidence.hollow, &evidence.overhanging}) {
    // Once and for all: evidence changes places between solids of any size.
    if (list->capacity() < room) list->reserve(2 * room);
    list->resize(room);
  }
  RayCounts counts;
  counts.explained = evidence.explained.data();
  counts.fits = evidence.fits.data();
  counts.hollow = evidence.hollow.data();
  counts.overhanging = evidence.overhanging.data();
  CastWindow(AsRaySolid(solid, observation.support), window, kLimits, &counts);
  DropOfOthers(observation, &counts);
  evidence.explained.resize(static_cast<size_t>(counts.num_explained));
  evidence.fits.resize(static_cast<size_t>(counts.num_explained));
  evidence.hollow.resize(static_cast<size_t>(counts.num_hollow));
  evidence.overhanging.resize(static_cast<size_t>(counts.num_overhanging));
  evidence.fit_sum = counts.fit;
  evidence.window = {window.u_begin, window.u_end, window.v_begin, window.v_end};
  const int weight = observation.grid.pixel_weight();
  evidence.pixel_weight = weight;
  evidence.num_contradicting = weight * counts.num_contradicting;
  evidence.num_occluded = weight * counts.num_occluded;
  evidence.num_violating = weight * counts.num_violating;
  evidence.num_unknown = weight * counts.num_unknown;
}

double FitAlone(const RayEvidence& evidence, const std::vector<uint8_t>& num_explaining,
                int max_num) {
  int64_t fit_sum = 0;
  for (size_t i = 0; i < evidence.explained.size(); ++i) {
    const bool is_alone = num_explaining[static_cast<size_t>(evidence.explained[i])] <= max_num;
    fit_sum += is_alone ? evidence.fits[i] : 0;
  }
  return static_cast<double>(evidence.pixel_weight * fit_sum) / kFitUnit;
}

int NumOverhangingAlone(const RayEvidence& evidence, const std::vector<uint8_t>& num_explaining) {
  const auto num =
      std::count_if(evidence.overhanging.begin(), evidence.overhanging.end(),
                    [&](int32_t pixel) { return num_explaining[static_cast<size_t>(pixel)] == 0; });
  return evidence.pixel_weight * static_cast<int>(num);
}

void FindExplainedPoints(const Solid& solid, const RayEvidence& evidence,
                         const Observation& observation, std::vector<Eigen::Vector3d>* points_O) {
  const PixelGrid& grid = observation.grid;
  const Eigen::Isometry3d X_OC = solid.X_CO.inverse();
  points_O->clear();
  // Pixels come in their order: rows are counted along instead of divided out.
  int row_begin = 0;
  size_t v = 0;
  for (const int32_t pixel : evidence.explained) {
    for (; pixel >= row_begin + grid.columns; row_begin += grid.columns) ++v;
    const auto u = static_cast<size_t>(pixel - row_begin);
    const double z = grid.z[v * grid.stride + u];
    points_O->push_back(X_OC * Eigen::Vector3d(z * grid.ray_x[u], z * grid.ray_y[v], z));
  }
}

int NumNear(const Solid& solid, double reach_m, const Observation& observation) {
  static const RayLimits kLimits = LimitsWith(kNeighbourMinHeight);
  return CountNear(AsRaySolid(solid, observation.support), WindowOf(solid, reach_m, observation),
                   kLimits, static_cast<float>(reach_m));
}

double SurfaceTolerance(double z) {
  return std::max(kMinTolerance, kToleranceInSigmas * MeasurementSigma(z));
}

}  // namespace declutter
