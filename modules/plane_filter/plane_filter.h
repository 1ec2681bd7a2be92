#pragma once

#include "modules/geometry/depth_image.h"
#include "modules/geometry/tabletop.h"
#include "modules/plane_filter/plane_filter.pb.h"

namespace declutter {

// Finds the support planes of a depth image and keeps what stands on them (paper, section 3, steps
// i and ii).
class PlaneFilter {
 public:
  explicit PlaneFilter(const PlaneFilterConfig& config);

  // The tabletop of a frame in its camera frame C. Object pixels are those of the main support;
  // further planes are parallel to it and fill at least 2 % of the image, the floor for example,
  // and tops of objects are not listed. A frame without a plane, or with an error, gives a tabletop
  // without planes and without object points.
  Tabletop Filter(const DepthFrame& frame) const;

 private:
  PlaneFilterConfig config_;
};

}  // namespace declutter
