#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "modules/geometry/image_components.h"
#include "modules/geometry/random_index.h"
#include "modules/plane_filter/inverse_depth.h"
#include "modules/plane_filter/plane_filter.pb.h"

namespace declutter {

// Finds where an image lies in a plane instead of being cut by it. Like all classes of this module
// it uses its memory again: what it returns is valid until the next call.
class CoherentRegion {
 public:
  // The inliers of the plane, all those within band [1/m], whose neighbours mostly are inliers too,
  // in connected regions of at least min_region_pixels with small residuals.
  const PixelMask& Find(const InverseDepth& image, const InversePlane& plane,
                        const PixelMask& inliers, float band, int min_region_pixels);

 private:
  PixelMask region_;
  ComponentRuns components_;
  std::vector<double> sum_squares_;  // [1/m^2] of the residuals, per component
};

// Dominant planes.
struct PlaneCandidates {
  struct Candidate {
    InversePlane plane;
    int num_pixels = 0;  // of its region
  };

  std::vector<Candidate> planes;
  // Per pixel: 1 + the index of the plane whose coherent region it is in; 0: none.
  std::vector<uint8_t> region_of;

  bool IsIn(size_t pixel, size_t plane) const { return region_of[pixel] == plane + 1; }
};

// Dominant planes by RANSAC, refined by least squares, largest first as they are found and removed
// (paper, section 3, step i).
class PlaneSearch {
 public:
  explicit PlaneSearch(const PlaneFilterConfig& config) : config_(config) {}

  // sigma: standard deviation of 1 / z on a flat surface [1/m].
  const PlaneCandidates& Find(const InverseDepth& grid, double sigma);

 private:
  // The pixels of a grid that have a measurement, in no need of their places.
  struct PixelList {
    std::vector<float> x, y, values;  // rays and 1 / z [1/m]; zeros for kernels at the end
    size_t num = 0;
  };

  void ListMeasured();
  std::optional<InversePlane> BestSample(float band, RandomIndex* random) const;
  void Add(const InversePlane& plane, const PixelMask& region, int num_pixels);

  PlaneFilterConfig config_;
  InverseDepth rest_;  // pixels of planes found are removed
  PixelList measured_;
  PixelMask inliers_;
  CoherentRegion region_;
  PlaneCandidates candidates_;
};

}  // namespace declutter
