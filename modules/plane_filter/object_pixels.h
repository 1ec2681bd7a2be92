#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/image_components.h"
#include "modules/plane_filter/inverse_depth.h"
#include "modules/plane_filter/plane_filter.pb.h"
#include "modules/plane_filter/prism.h"

namespace declutter {

// Finds the pixels of what stands on the support: connected regions that rise clearly above it,
// over its hull (widened where a region as a whole stands there), and down to their feet (paper,
// section 3, step i).
class ObjectPixels {
 public:
  explicit ObjectPixels(const PlaneFilterConfig& config) : config_(config) {}

  // hull_T as PlaneHull gives it; sigma is the standard deviation of 1 / z on a flat surface [1/m].
  // Pixels in or behind a wall are not objects. The result is valid until the next call, which uses
  // all memory again.
  const PixelMask& Find(const InverseDepth& image, const InversePlane& support,
                        const std::vector<Eigen::Vector2d>& hull_T,
                        const std::vector<InversePlane>& walls, double sigma);

 private:
  void Classify(const InverseDepth& image, const InversePlane& support,
                const std::vector<InversePlane>& walls, double sigma);
  void CountStanding(const InverseDepth& image);
  void MarkStanding(const InverseDepth& image, double sigma);
  void AddFeet(const InverseDepth& image, int reach);
  void DropStreaks(const InverseDepth& image);

  PlaneFilterConfig config_;
  Prism hull_, widened_;
  std::vector<uint8_t> classes_;  // 0 not above the support, 1 as high as a foot, 2 as an object
  PixelMask tall_;
  ComponentRuns regions_;              // of tall_
  PixelMask over_hull_;                // where tall
  std::vector<int32_t> num_standing_;  // per region: pixels over the widened hull
  PixelMask standing_;
  PixelMask near_rows_;                    // what is near standing_ in its row
  std::vector<uint8_t> lives_from_above_;  // > 0: what is near below that
  PixelMask with_feet_;
  PixelMask objects_;
  std::vector<uint8_t> row_, other_row_;
};

}  // namespace declutter
