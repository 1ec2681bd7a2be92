#include "modules/model_verifier/late_proposals.h"

#include <algorithm>
#include <utility>

#include "modules/geometry/plane.h"
#include "modules/model_verifier/projection.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {
namespace {

constexpr double kMargin = 0.10;    // [m] around the selected solids
constexpr float kMinHeight = 1.5f;  // [tolerances] of points that need an explanation

// What all solids with a margin project to.
PixelWindow WindowOf(const std::vector<Solid>& solids, const Observation& observation) {
  PixelWindow all{observation.grid.columns, 0, observation.grid.rows, 0};
  for (const Solid& solid : solids) {
    const RayWindow one = WindowOf(solid, kMargin, observation);
    all = {std::min(all.u_begin, one.u_begin), std::max(all.u_end, one.u_end),
           std::min(all.v_begin, one.v_begin), std::max(all.v_end, one.v_end)};
  }
  return all;
}

// Marks the points of a window that need an explanation and have none, and no others.
void MarkUnexplained(const std::vector<uint8_t>& is_explained, const PixelWindow& window,
                     const Observation& observation, std::vector<uint8_t>* marked) {
  const PixelGrid& grid = observation.grid;
  const Eigen::Vector3f up = observation.support.normal.cast<float>();
  const auto camera_height = static_cast<float>(observation.support.d);
  std::vector<uint8_t>& is_marked = *marked;
  is_marked.assign(is_explained.size(), 0);
  for (int v = window.v_begin; v < window.v_end; ++v) {
    const auto row = static_cast<size_t>(v);
    for (int u = window.u_begin; u < window.u_end; ++u) {
      const auto column = static_cast<size_t>(u);
      const size_t pixel = row * static_cast<size_t>(grid.columns) + column;
      const float z = grid.z[row * grid.stride + column];
      if (z <= 0 || is_explained[pixel]) continue;
      const float height =
          camera_height + z * up.dot(Eigen::Vector3f(grid.ray_x[column], grid.ray_y[row], 1));
      is_marked[pixel] = height > kMinHeight * static_cast<float>(SurfaceTolerance(z));
    }
  }
}

bool IsMostlyIn(const ConvexRegion& region, const SurfacePart& part) {
  size_t num = 0;
  for (const auto* points : {&part.tops, &part.sides}) {
    for (const Eigen::Vector3f& p : *points) num += region.Contains(p.x(), p.y());
  }
  return 2 * num > part.num_points();
}

}  // namespace

void LateProposer::SetRegion(const std::vector<Solid>& solids, const Eigen::Isometry3d& X_TC) {
  corners_.clear();
  for (const Solid& solid : solids) {
    for (int k = 0; k < 8; ++k) {
      const Eigen::Vector3d sign((k & 1) - 0.5, ((k >> 1) & 1) - 0.5, ((k >> 2) & 1) - 0.5);
      const Eigen::Vector3d corner_T = X_TC * (solid.X_CO * sign.cwiseProduct(solid.size));
      corners_.push_back(corner_T.head<2>());
    }
  }
  ConvexHull(&corners_, &hull_);
  region_ = ConvexRegion(hull_, kMargin, std::move(region_));
}

const std::vector<LateProposal>& LateProposer::ProposeForUnexplained(
    const std::vector<Solid>& selected, const std::vector<uint8_t>& is_explained, double min_px,
    const Observation& observation) {
  proposals_.clear();
  if (selected.empty()) return proposals_;
  const int pixel_weight = observation.grid.pixel_weight();
  const Eigen::Isometry3d X_TC = TableFrame(observation.support);
  const Eigen::Isometry3d X_CT = X_TC.inverse();
  const PixelWindow window = WindowOf(selected, observation);
  MarkUnexplained(is_explained, window, observation, &is_marked_);
  SetRegion(selected, X_TC);
  for (const SurfacePart& part : parts_.Find(
           is_marked_, window, X_TC, static_cast<size_t>(min_px / pixel_weight), observation)) {
    if (!IsMostlyIn(region_, part)) continue;
    for (const Hypothesis& hypothesis : completion_.SolidsOver(part, X_CT)) {
      proposals_.push_back({hypothesis, pixel_weight * static_cast<int>(part.num_points())});
    }
  }
  AddLeaning(window, X_TC, observation);
  return proposals_;
}

const std::vector<LateProposal>& LateProposer::ProposeLeaning(const std::vector<Solid>& others,
                                                              const Observation& observation) {
  proposals_.clear();
  if (others.empty()) return proposals_;
  const Eigen::Isometry3d X_TC = TableFrame(observation.support);
  const PixelWindow window = WindowOf(others, observation);
  is_explained_.assign(static_cast<size_t>(observation.grid.num_pixels()), 0);
  MarkUnexplained(is_explained_, window, observation, &is_marked_);
  SetRegion(others, X_TC);
  AddLeaning(window, X_TC, observation);
  return proposals_;
}

void LateProposer::AddLeaning(const PixelWindow& window, const Eigen::Isometry3d& X_TC,
                              const Observation& observation) {
  constexpr int kMinFacePx = 400;  // that tell how a face is turned to a few degrees
  for (const LeaningBox& box : leaning_.Find(is_marked_, window, kMinFacePx, observation)) {
    const Eigen::Vector3d centre_T = X_TC * box.solid.X_CO.translation();
    if (!region_.Contains(static_cast<float>(centre_T.x()), static_cast<float>(centre_T.y()))) {
      continue;
    }
    Hypothesis hypothesis;
    hypothesis.solid = box.solid;
    proposals_.push_back({hypothesis, box.num_px});
  }
}

}  // namespace declutter
