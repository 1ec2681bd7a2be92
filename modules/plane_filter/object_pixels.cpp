#include "modules/plane_filter/object_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "modules/geometry/image_components.h"
#include "modules/geometry/marked_pixels.h"
#include "modules/plane_filter/pixel_kernels.h"
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

uint8_t IsTall(uint8_t height_class) { return height_class == 2; }
uint8_t Or(uint8_t a, uint8_t b) { return a | b; }

// Per pixel: 0 is not above the support, 1 as high as a foot, 2 as high as an object.
std::vector<uint8_t> HeightClasses(const InverseDepth& image, const InversePlane& support,
                                   const PlaneFilterConfig& config) {
  const float camera_height = static_cast<float>(support.ToPlane().d);
  const float sigma = static_cast<float>(config.inverse_depth_sigma());
  // height = camera_height * residual / value, see InversePlane::ToPlane.
  const float min_slope = static_cast<float>(config.min_height_m()) / camera_height;
  const float object_slope = static_cast<float>(config.object_height_m()) / camera_height;
  const float max_slope = static_cast<float>(config.max_height_m()) / camera_height;
  const HeightLimits limits{kFootSigmas * sigma, kObjectSigmas * sigma, min_slope, object_slope,
                            max_slope};
  std::vector<uint8_t> classes(image.values.size());
  for (int v = 0; v < image.height; ++v) {
    const float row = support.b * image.ray_y[static_cast<size_t>(v)] + support.c;
    ClassifyHeights(image.ray_x.data(), &image.values[image.Index(0, v)],
                    static_cast<size_t>(image.width), support.a, row, limits,
                    &classes[image.Index(0, v)]);
  }
  return classes;
}

// Sets pixels to 0 that are not more than band [1/m] in front of the wall.
void ClearBehind(const InverseDepth& image, const InversePlane& wall, float band,
                 std::vector<uint8_t>* classes) {
  for (int v = 0; v < image.height; ++v) {
    const float y = image.ray_y[static_cast<size_t>(v)];
    const float* values = &image.values[image.Index(0, v)];
    uint8_t* out = &(*classes)[image.Index(0, v)];
    for (int u = 0; u < image.width; ++u) {
      const bool is_in_front = values[u] - wall.At(image.ray_x[static_cast<size_t>(u)], y) > band;
      out[u] = is_in_front ? out[u] : uint8_t{0};
    }
  }
}

// Marks a row of pixels where a marked one is at most reach away.
void DilateRow(const uint8_t* in, int width, int reach, uint8_t* out) {
  for (const uint8_t* first = in;;) {
    first =
        static_cast<const uint8_t*>(std::memchr(first, 1, static_cast<size_t>(in + width - first)));
    if (first == nullptr) return;
    const uint8_t* end = std::find(first, in + width, uint8_t{0});
    const int from = std::max(static_cast<int>(first - in) - reach, 0);
    const int to = std::min(static_cast<int>(end - in) + reach, width);
    std::memset(out + from, 1, static_cast<size_t>(to - from));
    first = end;
  }
}

// Marks pixels with a marked one at most reach away in row and column. Over the columns every pass
// lets a mark live for reach more steps, in all columns in parallel.
PixelMask Dilate(const InverseDepth& image, const PixelMask& mask, int reach) {
  reach = std::min(reach, 254);
  const uint8_t full = static_cast<uint8_t>(reach + 1);
  const size_t width = static_cast<size_t>(image.width);
  PixelMask dilated(mask.size());
  for (size_t row = 0; row < mask.size(); row += width) {
    DilateRow(&mask[row], image.width, reach, &dilated[row]);
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
  PixelMask over_hull(tall.size());
  PixelMask over_widened(tall.size());
  for (int v = 0; v < image.height; ++v) {
    const size_t row = image.Index(0, v);
    hull.MarkContained(image, v, &tall[row], &over_hull[row]);
    widened.MarkContained(image, v, &tall[row], &over_widened[row]);
  }
  ForEachMarked(tall.data(), 0, tall.size(), [&](size_t i) {
    num_inside[static_cast<size_t>(regions.label[i])] += over_hull[i] | over_widened[i];
  });
  PixelMask standing(tall.size());
  const int32_t min_pixels = config.min_object_pixels();
  ForEachMarked(tall.data(), 0, tall.size(), [&](size_t i) {
    const size_t region = static_cast<size_t>(regions.label[i]);
    const int32_t num_pixels = regions.num_pixels[region];
    if (num_pixels < min_pixels) return;
    standing[i] = over_hull[i] || 2 * num_inside[region] > num_pixels;
  });
  return standing;
}

// Without low pixels whose neighbours are mostly none: the sensor's noise is correlated along rows
// and makes thin streaks beside objects.
PixelMask WithoutStreaks(const InverseDepth& image, const PixelMask& objects,
                         const PixelMask& standing) {
  PixelMask kept = Amid(image, objects, kMinNeighborhood);
  std::transform(kept.begin(), kept.end(), standing.begin(), kept.begin(), Or);
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
  std::transform(classes.begin(), classes.end(), tall.begin(), IsTall);
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
  // Feet near what stands, and what stands.
  std::transform(
      objects.begin(), objects.end(), classes.begin(), objects.begin(),
      [](uint8_t near, uint8_t height_class) -> uint8_t { return near & (height_class == 1); });
  std::transform(objects.begin(), objects.end(), standing.begin(), objects.begin(), Or);
  return WithoutStreaks(image, objects, standing);
}

}  // namespace declutter
