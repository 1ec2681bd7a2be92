#pragma once

#include "modules/geometry/depth_image.h"
#include "modules/geometry/plane.h"
#include "modules/model_verifier/gradient_normals.h"
#include "modules/model_verifier/image_noise.h"
#include "modules/model_verifier/pixel_grid.h"

namespace declutter {

// What the camera measured, at the pixels of a grid.
struct Observation {
  const DepthImage& image;
  const PixelGrid& grid;
  const GradientNormals& normals;
  const Plane& support;
  const ImageNoise& noise;

  // The same at the pixels of another grid.
  Observation At(const PixelGrid& other) const { return {image, other, normals, support, noise}; }

  // The first row or column of the grid that is not before `begin` [px of the image].
  int First(int begin) const { return (begin + grid.step - 1) / grid.step; }
};

// A depth image with all that is computed from it once. Buffers are used again for the next one.
class ObservedImage {
 public:
  // image and support must outlive what is returned below.
  void Set(const DepthImage& image, const Plane& support);

  Observation every_pixel() const { return {*image_, all_, normals_, *support_, noise_}; }
  Observation every_second_pixel() const { return {*image_, half_, normals_, *support_, noise_}; }

 private:
  const DepthImage* image_ = nullptr;
  const Plane* support_ = nullptr;
  PixelGrid all_;
  PixelGrid half_;
  GradientNormals normals_;
  ImageNoiseMeter noise_meter_;
  ImageNoise noise_;
};

}  // namespace declutter
