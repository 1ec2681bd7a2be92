#pragma once

#include <vector>

#include "modules/geometry/plane.h"
#include "modules/model_verifier/pixel_grid.h"

namespace declutter {

// What the errors of a depth image are like, from how the support plane is seen.
struct ImageNoise {
  // How large the errors are that many points of a surface share, as a multiple of a Kinect's. 1
  // where too little of the plane is seen.
  double level = 1;
  // In [0, 1]: how little pixels beside each other share of their errors. About 0.4 of a Kinect,
  // whose depths are those of windows of pixels, 1 where each is measured by itself. 0 where too
  // little is seen.
  double independence = 0;
};

// Buffers are used again for the next image.
class ImageNoiseMeter {
 public:
  ImageNoise Measure(const PixelGrid& every_pixel, const Plane& support);

 private:
  std::vector<float> means_, independences_;  // of blocks
};

}  // namespace declutter
