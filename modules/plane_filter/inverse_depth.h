#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/plane.h"

namespace declutter {

// A depth image as 1 / z. A disparity sensor measures 1 / z with the same noise at every distance,
// and a plane is linear in it: 1 / z = a x + b y + c over the rays (x, y, 1) of C.
struct InverseDepth {
  int width = 0;              // [px]
  int height = 0;             // [px]
  std::vector<float> ray_x;   // per column
  std::vector<float> ray_y;   // per row
  std::vector<float> values;  // [1/m] row-major; 0 is no measurement

  size_t Index(int u, int v) const {
    return static_cast<size_t>(v) * static_cast<size_t>(width) + static_cast<size_t>(u);
  }
};

// Here and below `recycled` gives its memory to the result.
InverseDepth Invert(const DepthImage& image, InverseDepth recycled = {});

// Every stride-th pixel of every stride-th row.
InverseDepth Subsample(const InverseDepth& image, int stride, InverseDepth recycled = {});

// The plane 1 / z = a x + b y + c.
struct InversePlane {
  float a = 0;
  float b = 0;
  float c = 0;

  float At(float x, float y) const { return a * x + b * y + c; }

  // In C, normal toward the camera.
  Plane ToPlane() const;
};

// Marks pixels; row-major, as long as the image.
using PixelMask = std::vector<uint8_t>;

// Pixels that deviate from the plane by at most band [1/m].
PixelMask PlaneInliers(const InverseDepth& image, const InversePlane& plane, float band,
                       PixelMask recycled = {});

// Marked pixels, none at the border of the image, with at least min_marked marked ones among
// themselves and their 8 neighbours.
PixelMask Amid(const InverseDepth& image, const PixelMask& mask, int min_marked,
               PixelMask recycled = {});

// Least squares over the marked pixels (all of them without a mask) within band [1/m] of the plane,
// weighted by the sensor's noise; nullopt when they do not fix a plane.
std::optional<InversePlane> FitInliers(const InverseDepth& image, const PixelMask* mask,
                                       const InversePlane& plane, float band);

}  // namespace declutter
