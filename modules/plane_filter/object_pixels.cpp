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

// Object pixels among a low pixel and its 8 neighbours.
constexpr int kMinNeighborhood = 6;

// Per pixel: 0 is not above the support, 1 as high as a foot, 2 as high as an object.
std::vector<uint8_t> HeightClasses(const InverseDepth& image, const InversePlane& support,
                                   const PlaneFilterConfig& config) {
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
    uint8_t* out = &classes[image.Index(0, v)];
    for (int u = 0; u < image.width; ++u) {
      const float value = values[u];
      const float residual = value - (support.a * image.ray_x[static_cast<size_t>(u)] + row);
      const bool foot = (value > 0) & (residual < max_slope * value) &
                        (residual > std::max(kFootSigmas * sigma, min_slope * value));
      const bool object = residual > std::max(kObjectSigmas * sigma, object_slope * value);
      out[u] = static_cast<uint8_t>(foot + (foot & object));
    }
  }
  return classes;
}

// Sets pixels to 0 that are not more than band [1/m] in front of the wall.
void ClearBehind(const InverseDepth& image, const InversePlane& wall, float band,
                 std::vector<uint8_t>* classes) {
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const size_t i = image.Index(u, v);
      const float wall_value =
          wall.At(image.ray_x[static_cast<size_t>(u)], image.ray_y[static_cast<size_t>(v)]);
      if (image.values[i] - wall_value <= band) (*classes)[i] = 0;
    }
  }
}

// Marks pixels with a marked one at most reach away in row and column. Every pass lets a mark live
// for reach more steps; the passes over rows of pixels at once run for all columns in parallel.
PixelMask Dilate(const InverseDepth& image, const PixelMask& mask, int reach) {
  const uint8_t full = static_cast<uint8_t>(std::min(reach, 254) + 1);
  const size_t width = static_cast<size_t>(image.width);
  PixelMask dilated(mask.size());
  const auto spread_row = [&](const uint8_t* in, uint8_t* out, int first, int step) {
    int life = 0;
    for (int i = 0, u = first; i < image.width; ++i, u += step) {
      life = in[u] ? full : std::max(life - 1, 0);
      out[u] |= life > 0;
    }
  };
  for (size_t row = 0; row < mask.size(); row += width) {
    spread_row(&mask[row], &dilated[row], 0, 1);
    spread_row(&mask[row], &dilated[row], image.width - 1, -1);
  }
  const PixelMask rows = dilated;
  std::vector<uint8_t> lives(width);
  const auto spread_columns = [&](int v) {
    const uint8_t* in = &rows[image.Index(0, v)];
    uint8_t* out = &dilated[image.Index(0, v)];
    for (size_t u = 0; u < width; ++u) {
      const uint8_t aged = static_cast<uint8_t>(lives[u] - (lives[u] > 0));
      lives[u] = in[u] ? full : aged;
      out[u] |= lives[u] > 0;
    }
  };
  for (int v = 0; v < image.height; ++v) spread_columns(v);
  std::fill(lives.begin(), lives.end(), uint8_t{0});
  for (int v = image.height - 1; v >= 0; --v) spread_columns(v);
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

// Without low pixels whose neighbours are mostly none: the sensor's noise is correlated along rows
// and makes thin streaks beside objects.
PixelMask WithoutStreaks(const InverseDepth& image, const PixelMask& objects,
                         const PixelMask& standing) {
  PixelMask kept = standing;
  for (int v = 1; v + 1 < image.height; ++v) {
    for (int u = 1; u + 1 < image.width; ++u) {
      const size_t i = image.Index(u, v);
      if (!objects[i] || standing[i]) continue;
      int num_objects = 0;
      for (int dv = -1; dv <= 1; ++dv) {
        const uint8_t* row = &objects[image.Index(u, v + dv)];
        num_objects += row[-1] + row[0] + row[1];
      }
      kept[i] = num_objects >= kMinNeighborhood;
    }
  }
  return kept;
}

}  // namespace

PixelMask ObjectPixels(const InverseDepth& image, const InversePlane& support,
                       const std::vector<Eigen::Vector2d>& hull_T,
                       const std::vector<InversePlane>& walls, const PlaneFilterConfig& config) {
  std::vector<uint8_t> classes = HeightClasses(image, support, config);
  const float wall_band = static_cast<float>(config.inlier_sigmas() * config.inverse_depth_sigma());
  for (const InversePlane& wall : walls) ClearBehind(image, wall, wall_band, &classes);
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
  return WithoutStreaks(image, objects, standing);
}

}  // namespace declutter
