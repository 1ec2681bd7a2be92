#pragma once

#include <cstdint>
#include <vector>

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
  // Of each pixel of the grid the solid that it belongs to, 0: none, and the one that looks: what
  // belongs to others it does not explain. Null: nobody knows.
  const std::vector<uint8_t>* owners = nullptr;
  uint8_t owner = 0;

  // The same at the pixels of another grid, of which nobody knows the owners.
  Observation At(const PixelGrid& other) const { return {image, other, normals, support, noise}; }
  // The same as one of the owners sees it.
  Observation For(uint8_t looking, const std::vector<uint8_t>& owners_of_pixels) const {
    return {image, grid, normals, support, noise, &owners_of_pixels, looking};
  }

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
