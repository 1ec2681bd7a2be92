#pragma once

#include <memory>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/kinect_source/camera_file.h"

namespace declutter {

// Takes the distortion of a lens out of images: each pixel gets the value of the nearest one that
// sees its ray, 0 where there is none. Depths are not mixed: between two surfaces there is nothing.
class Rectification {
 public:
  // The images keep the intrinsics of `camera`.
  Rectification(const PinholeCamera& camera, const Distortion& distortion);

  void Apply(DepthImage* image) const;
  void Apply(ColorImage* image) const;

 private:
  std::vector<int> source_;  // of each pixel; -1: none
};

// Null for a file that tells of no distortion.
std::shared_ptr<const Rectification> RectificationOf(const CameraFile& file);

}  // namespace declutter
