#include "modules/plane_filter/object_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "modules/geometry/for_each_processor.h"
#include "modules/plane_filter/pixel_kernels.h"

namespace declutter {
namespace {

// Standard deviations of 1 / z by which feet, and upper parts, are off the plane: a far table has
// waves of four somewhere.
constexpr float kFootSigmas = 1.5f;
constexpr float kObjectSigmas = 5.0f;

// Largest step of 1 / z within a region, in standard deviations.
constexpr float kStepSigmas = 10.0f;

// Low pixels belong to a region this many times its necessary height away in the image.
constexpr double kFootReach = 1.5;

// Object pixels among a low pixel and its 8 neighbours.
constexpr int kMinNeighborhood = 6;

HeightLimits LimitsAbove(const InversePlane& support, const PlaneFilterConfig& config,
                         float sigma) {
  const float camera_height = static_cast<float>(support.ToPlane().d);
  // height = camera_height * residual / value, see InversePlane::ToPlane.
  const float min_slope = static_cast<float>(config.min_height_m()) / camera_height;
  const float object_slope = static_cast<float>(config.object_height_m()) / camera_height;
  const float max_slope = static_cast<float>(config.max_height_m()) / camera_height;
  return {kFootSigmas * sigma, kObjectSigmas * sigma, min_slope, object_slope, max_slope};
}

// The loops over pixels are given plain arrays, for the compiler to make vectors of them.

// Sets the pixels of a row to 0 that are not more than band [1/m] in front of the wall.
DECLUTTER_FOR_EACH_PROCESSOR void ClearBehind(const float* x, float y, const float* values,
                                              size_t num, const InversePlane& wall, float band,
                                              uint8_t* classes) {
  const float a = wall.a, by = wall.b * y, c = wall.c;
  for (size_t u = 0; u < num; ++u) {
    classes[u] = values[u] - (a * x[u] + by + c) > band ? classes[u] : uint8_t{0};
  }
}

DECLUTTER_FOR_EACH_PROCESSOR void MarkTall(const uint8_t* classes, size_t num, uint8_t* tall) {
  for (size_t u = 0; u < num; ++u) tall[u] = classes[u] == 2;
}

// Pixels of a, but not of b.
DECLUTTER_FOR_EACH_PROCESSOR void Without(const uint8_t* a, const uint8_t* b, size_t num,
                                          uint8_t* without) {
  for (size_t u = 0; u < num; ++u) without[u] = a[u] > b[u];
}

// Row by row, and in all columns in parallel, a mark lives for `reach` more steps.
DECLUTTER_FOR_EACH_PROCESSOR void Age(const uint8_t* marked, size_t num, uint8_t reach,
                                      uint8_t* lives) {
  const auto full = static_cast<uint8_t>(reach + 1);
  for (size_t u = 0; u < num; ++u) {
    const auto aged = static_cast<uint8_t>(lives[u] - (lives[u] > 0));
    lives[u] = marked[u] > 0 ? full : aged;
  }
}

// What stands, and low pixels where a mark lives, from above or from below.
DECLUTTER_FOR_EACH_PROCESSOR void MarkFeet(const uint8_t* classes, const uint8_t* standing,
                                           const uint8_t* above, const uint8_t* below, size_t num,
                                           uint8_t* with_feet) {
  for (size_t u = 0; u < num; ++u) {
    const uint8_t foot = ((above[u] | below[u]) > 0) & (classes[u] == 1);
    with_feet[u] = static_cast<uint8_t>(foot | standing[u]);
  }
}

DECLUTTER_FOR_EACH_PROCESSOR void Unite(const uint8_t* marked, size_t num, uint8_t* with_marked) {
  for (size_t u = 0; u < num; ++u) with_marked[u] |= marked[u];
}

// How far away feet of what stands may be [px].
int FootReach(const InverseDepth& image, const InversePlane& support, double object_height_m) {
  // 1 / z of the support in the middle of the image and the width of a pixel there.
  const float middle = support.At(image.ray_x[static_cast<size_t>(image.width / 2)],
                                  image.ray_y[static_cast<size_t>(image.height / 2)]);
  const double pixel_angle =
      static_cast<double>(image.ray_x.back() - image.ray_x.front()) / image.width;
  return std::clamp(
      static_cast<int>(std::ceil(kFootReach * object_height_m * middle / pixel_angle)), 1,
      image.width);
}

// Marks the pixels of a row that have a marked one at most reach away.
void DilateRow(const uint8_t* in, int width, int reach, uint8_t* out) {
  std::memset(out, 0, static_cast<size_t>(width));
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

int32_t NumMarked(const uint8_t* begin, const uint8_t* end) {
  int32_t num = 0;
  for (; begin < end; ++begin) num += *begin;
  return num;
}

}  // namespace

void ObjectPixels::Classify(const InverseDepth& image, const InversePlane& support,
                            const std::vector<InversePlane>& walls, double sigma) {
  const HeightLimits limits = LimitsAbove(support, config_, static_cast<float>(sigma));
  const float wall_band = static_cast<float>(config_.inlier_sigmas() * sigma);
  const auto width = static_cast<size_t>(image.width);
  classes_.resize(image.values.size());
  tall_.resize(image.values.size());
  for (int v = 0; v < image.height; ++v) {
    const size_t begin = image.Index(0, v);
    uint8_t* classes = &classes_[begin];
    const float y = image.ray_y[static_cast<size_t>(v)];
    const float row = support.b * y + support.c;
    ClassifyHeights(image.ray_x.data(), &image.values[begin], width, support.a, row, limits,
                    classes);
    for (const InversePlane& wall : walls) {
      ClearBehind(image.ray_x.data(), y, &image.values[begin], width, wall, wall_band, classes);
    }
    MarkTall(classes, width, &tall_[begin]);
  }
}

// Of each region, the pixels over the hull and over the widened one, which contains it.
void ObjectPixels::CountStanding(const InverseDepth& image) {
  const auto width = static_cast<size_t>(image.width);
  std::vector<uint8_t>& outside = row_;
  std::vector<uint8_t>& over_widened = other_row_;
  over_hull_.resize(tall_.size());
  outside.resize(width);
  over_widened.resize(width);
  num_standing_.assign(regions_.num_pixels.size(), 0);
  for (size_t v = 0; v < static_cast<size_t>(image.height); ++v) {
    const size_t begin = v * width;
    const size_t first_run = regions_.first_run[v], last_run = regions_.first_run[v + 1];
    if (first_run == last_run) continue;
    hull_.MarkContained(image, static_cast<int>(v), &tall_[begin], &over_hull_[begin]);
    Without(&tall_[begin], &over_hull_[begin], width, outside.data());
    widened_.MarkContained(image, static_cast<int>(v), outside.data(), over_widened.data());
    for (size_t i = first_run; i < last_run; ++i) {
      const ComponentRun& run = regions_.runs[i];
      num_standing_[static_cast<size_t>(run.component)] +=
          NumMarked(&over_hull_[run.begin], &over_hull_[run.end]) +
          NumMarked(&over_widened[run.begin - begin], &over_widened[run.end - begin]);
    }
  }
}

// Of the regions as high as objects: whole regions that mostly stand over the widened hull, and of
// the others what is over the hull itself.
void ObjectPixels::MarkStanding(const InverseDepth& image, double sigma) {
  const float step = kStepSigmas * static_cast<float>(sigma);
  regions_ =
      FindComponents(image.width, image.height, tall_, image.values, step, std::move(regions_));
  CountStanding(image);
  standing_.assign(tall_.size(), 0);
  for (const ComponentRun& run : regions_.runs) {
    const auto region = static_cast<size_t>(run.component);
    const int32_t num_pixels = regions_.num_pixels[region];
    if (num_pixels < config_.min_object_pixels()) continue;
    if (2 * num_standing_[region] > num_pixels) {
      std::memset(&standing_[run.begin], 1, run.end - run.begin);
    } else {
      std::memcpy(&standing_[run.begin], &over_hull_[run.begin], run.end - run.begin);
    }
  }
}

// What stands, and low pixels at most reach away from it in row and column.
void ObjectPixels::AddFeet(const InverseDepth& image, int reach) {
  const auto max_age = static_cast<uint8_t>(std::min(reach, 254));
  const auto width = static_cast<size_t>(image.width);
  const size_t size = standing_.size();
  std::vector<uint8_t>& lives = row_;
  near_rows_.resize(size);
  lives_from_above_.resize(size);
  with_feet_.resize(size);
  lives.assign(width, 0);
  for (size_t row = 0; row < size; row += width) {
    DilateRow(&standing_[row], image.width, max_age, &near_rows_[row]);
    Age(&near_rows_[row], width, max_age, lives.data());
    std::copy(lives.begin(), lives.end(), &lives_from_above_[row]);
  }
  std::fill(lives.begin(), lives.end(), uint8_t{0});
  for (size_t row = size; row > 0;) {
    row -= width;
    Age(&near_rows_[row], width, max_age, lives.data());
    MarkFeet(&classes_[row], &standing_[row], &lives_from_above_[row], lives.data(), width,
             &with_feet_[row]);
  }
}

// Leaves out low pixels whose neighbours are mostly none: the sensor's noise is correlated along
// rows and makes thin streaks beside objects.
void ObjectPixels::DropStreaks(const InverseDepth& image) {
  objects_ = Amid(image, with_feet_, kMinNeighborhood, std::move(objects_));
  Unite(standing_.data(), standing_.size(), objects_.data());
}

const PixelMask& ObjectPixels::Find(const InverseDepth& image, const InversePlane& support,
                                    const std::vector<Eigen::Vector2d>& hull_T,
                                    const std::vector<InversePlane>& walls, double sigma) {
  Classify(image, support, walls, sigma);
  hull_ = Prism(support, hull_T, 0.0, std::move(hull_));
  widened_ = Prism(support, hull_T, config_.hull_margin_m(), std::move(widened_));
  MarkStanding(image, sigma);
  AddFeet(image, FootReach(image, support, config_.object_height_m()));
  DropStreaks(image);
  return objects_;
}

}  // namespace declutter
