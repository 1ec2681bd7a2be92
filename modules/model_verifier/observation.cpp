#include "modules/model_verifier/observation.h"

namespace declutter {

void ObservedImage::Set(const DepthImage& image, const Plane& support) {
  image_ = &image;
  support_ = &support;
  all_.Set(image, 1);
  half_.Set(image, GradientNormals::kStep);
  normals_.Compute(image.camera, all_, half_);
  noise_ = noise_meter_.Measure(all_, support);
}

}  // namespace declutter
