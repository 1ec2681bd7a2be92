#pragma once

#include <cstdint>
#include <vector>

#include "modules/geometry/plane.h"
#include "modules/plane_filter/plane_filter.pb.h"
#include "modules/plane_filter/plane_search.h"
#include "modules/plane_filter/prism.h"

namespace declutter {

// A dominant plane as a support.
struct Carrier {
  Plane plane;                          // in C
  Prism prism;                          // over its hull
  std::vector<Eigen::Vector3d> region;  // points of its region in C
  double pixels = 0;                    // weighted number of pixels in the plane
  double load = 0;                      // weighted number of pixels that stand on it
};

// What the dominant planes of a scene are.
class SceneRoles {
 public:
  explicit SceneRoles(const PlaneFilterConfig& config) : config_(config) {}

  // sigma: standard deviation of 1 / z on a flat surface [1/m].
  void Assign(const InverseDepth& grid, const PlaneCandidates& candidates, double sigma);

  // Indices of the candidates. First the main support: the plane that is large, in the middle of
  // the image, roughly level and carries most; the floor carries less than the table that stands on
  // it, a wall nothing. Then planes parallel to it, largest first, such as the floor or other
  // tables; those over its hull are the tops of objects and no supports. Empty when there is no
  // candidate.
  const std::vector<size_t>& supports() const { return supports_; }

  // Steep planes at the border of the main support with nothing of it behind them: walls, or what
  // stands beside the table. A box as wide as all that is seen of the table cannot be told from
  // one.
  const std::vector<InversePlane>& walls() const { return walls_; }

 private:
  void MakeCarriers(const InverseDepth& grid, const PlaneCandidates& candidates);
  void FindNotLoad(const InverseDepth& grid, const PlaneCandidates& candidates, double sigma);
  void Weigh(const InverseDepth& grid, const PlaneCandidates& candidates);
  size_t MainSupport(const InverseDepth& grid, const PlaneCandidates& candidates) const;

  PlaneFilterConfig config_;
  std::vector<size_t> supports_;
  std::vector<InversePlane> walls_;
  PlaneHull hull_;
  std::vector<Carrier> carriers_;  // of all candidates, and perhaps more: those of earlier frames
  PixelMask not_load_;
  PixelMask inliers_;
};

}  // namespace declutter
