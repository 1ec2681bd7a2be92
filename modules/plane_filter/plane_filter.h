#pragma once

#include "modules/geometry/depth_image.h"
#include "modules/geometry/tabletop.h"
#include "modules/plane_filter/object_pixels.h"
#include "modules/plane_filter/outlier_filter.h"
#include "modules/plane_filter/plane_filter.pb.h"
#include "modules/plane_filter/plane_search.h"
#include "modules/plane_filter/prism.h"
#include "modules/plane_filter/scene_roles.h"

namespace declutter {

// Finds the support planes of a depth image and keeps what stands on them (paper, section 3, steps
// i and ii).
class PlaneFilter {
 public:
  explicit PlaneFilter(const PlaneFilterConfig& config);

  // The tabletop of a frame in its camera frame C. Object pixels are those of the main support;
  // further planes are parallel to it and fill at least 2 % of the image, the floor for example,
  // and tops of objects are not listed. A frame without a plane, or with an error, gives a tabletop
  // without planes and without object points. The result is valid until the next call, which uses
  // all memory again.
  const Tabletop& Filter(const DepthFrame& frame) &;
  Tabletop Filter(const DepthFrame& frame) && { return Filter(frame); }

 private:
  void FindTabletop(const DepthImage& image);
  const PixelMask& RegionOf(const InversePlane& plane);
  InversePlane Refine(const InversePlane& plane, const PixelMask& region) const;
  void KeepObjects(const DepthImage& image, const PixelMask& objects);

  PlaneFilterConfig config_;
  InverseDepth image_, grid_, half_;
  double sigma_ = 0;  // [1/m] of 1 / z on a flat surface
  std::vector<float> differences_;
  PlaneSearch search_;
  SceneRoles roles_;
  PixelMask inliers_;
  CoherentRegion region_;  // of a support, in half_
  PlaneHull hull_;
  ObjectPixels object_pixels_;
  OutlierFilter outlier_filter_;
  Tabletop tabletop_;
};

}  // namespace declutter
