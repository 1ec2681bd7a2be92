#include "modules/plane_filter/object_pixels.h"

#include <algorithm>
#include <cmath>

#include "modules/geometry/image_components.h"
#include "modules/plane_filter/prism.h"

namespace declutter {
namespace {

// Standard deviations of 1 / z by which feet, and upper parts, are off the plane.
constexpr float kFootSigmas = 1.5f;
constexpr float kObjectSigmas = 4.0f;

// Largest step of 1 / z within a region, in standard deviations.
constexpr float kStepSigmas = 10.0f;

// Low pixels belong to a region this many times its necessary height away in the image.
constexpr double kFootReach = 1.5;

// Per pixel: 0 is not above the support, 1 as high as a foot, 2 as high as an object.
std::vector<uint8_t> HeightClasses(const InverseDepth& image, const InversePlane& support,
                                   const PixelMask& background, const PlaneFilterConfig& config) {
  const float camera_height = static_cast<float>(support.ToPlane().d);
  const float sigma = static_cast<float>(config.inverse_depth_sigma());
  // height = camera_height * residual / value, see InversePlane::ToPlane.
  const float min_slope = static_cast<float>(config.min_height_m()) / camera_height;
  const float object_slope = static_cast<float>(config.object_height_m()) / camera_height;
  const float max_slope = static_cast<float>(config.max_height_m()) / camera_height;
  std::vector<uint8_t> classes(image.values.size());
  for (int v = 0; v < image.height; ++v) {
    const float row = support.b * image.ray_y[static_cast<size_t>(v)] + support.c;
    const float* values = &image.values[image.Index(0, v)];
    const uint8_t* excluded = &background[image.Index(0, v)];
    uint8_t* out = &classes[image.Index(0, v)];
    for (int u = 0; u < image.width; ++u) {
      const float value = values[u];
      const float residual = value - (support.a * image.ray_x[static_cast<size_t>(u)] + row);
      const bool foot = (value > 0) & (excluded[u] == 0) & (residual < max_slope * value) &
                        (residual > std::max(kFootSigmas * sigma, min_slope * value));
      const bool object = residual > std::max(kObjectSigmas * sigma, object_slope * value);
      out[u] = static_cast<uint8_t>(foot + (foot & object));
    }
  }
  return classes;
}

// Marks pixels with a marked one at most reach away in row and column.
PixelMask Dilate(const InverseDepth& image, const PixelMask& mask, int reach) {
  const auto spread = [reach](const uint8_t* in, uint8_t* out, int size, int step) {
    int last = -reach - 1;
    for (int i = 0; i < size + reach; ++i) {
      if (i < size && in[i * step]) last = i;
      if (i >= reach) out[(i - reach) * step] = i - last <= 2 * reach;
    }
  };
  PixelMask rows(mask.size());
  PixelMask dilated(mask.size());
  for (int v = 0; v < image.height; ++v) {
    spread(&mask[image.Index(0, v)], &rows[image.Index(0, v)], image.width, 1);
  }
  for (int u = 0; u < image.width; ++u) {
    spread(&rows[image.Index(u, 0)], &dilated[image.Index(u, 0)], image.height, image.width);
  }
  return dilated;
}

// Of the regions as high as objects: whole regions that mostly stand over the widened hull, and of
// the others what is over the hull itself.
PixelMask StandingRegions(const InverseDepth& image, const PixelMask& tall, const Prism& hull,
                          const Prism& widened, const PlaneFilterConfig& config) {
  const float step = kStepSigmas * static_cast<float>(config.inverse_depth_sigma());
  const ImageComponents regions =
      LabelComponents(image.width, image.height, tall, image.values, step);
  std::vector<int32_t> num_inside(regions.num_pixels.size());
  std::vector<uint8_t> place(tall.size());  // 2: over the hull, 1: over the widened hull
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const size_t i = image.Index(u, v);
      if (!tall[i]) continue;
      const float x = image.ray_x[static_cast<size_t>(u)];
      const float y = image.ray_y[static_cast<size_t>(v)];
      if (hull.Contains(x, y, image.values[i])) {
        place[i] = 2;
      } else if (widened.Contains(x, y, image.values[i])) {
        place[i] = 1;
      }
      num_inside[static_cast<size_t>(regions.label[i])] += place[i] > 0;
    }
  }
  PixelMask standing(tall.size());
  for (size_t i = 0; i < tall.size(); ++i) {
    if (!tall[i]) continue;
    const size_t region = static_cast<size_t>(regions.label[i]);
    const int32_t num_pixels = regions.num_pixels[region];
    if (num_pixels < config.min_object_pixels()) continue;
    standing[i] = place[i] == 2 || 2 * num_inside[region] > num_pixels;
  }
  return standing;
}

}  // namespace

PixelMask ObjectPixels(const InverseDepth& image, const InversePlane& support,
                       const std::vector<Eigen::Vector2d>& hull_T, const PixelMask& background,
                       const PlaneFilterConfig& config) {
  const std::vector<uint8_t> classes = HeightClasses(image, support, background, config);
  PixelMask tall(classes.size());
  for (size_t i = 0; i < tall.size(); ++i) tall[i] = classes[i] == 2;
  const PixelMask standing =
      StandingRegions(image, tall, Prism(support, hull_T, 0.0),
                      Prism(support, hull_T, config.hull_margin_m()), config);
  // 1 / z of the support in the middle of the image and the width of a pixel there.
  const float middle = support.At(image.ray_x[static_cast<size_t>(image.width / 2)],
                                  image.ray_y[static_cast<size_t>(image.height / 2)]);
  const double pixel_angle =
      static_cast<double>(image.ray_x.back() - image.ray_x.front()) / image.width;
  const int reach = std::clamp(
      static_cast<int>(std::ceil(kFootReach * config.object_height_m() * middle / pixel_angle)), 1,
      image.width);
  PixelMask objects = Dilate(image, standing, reach);
  for (size_t i = 0; i < objects.size(); ++i) {
    objects[i] = standing[i] || (objects[i] && classes[i] == 1);
  }
  return objects;
}

}  // namespace declutter
