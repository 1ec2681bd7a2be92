#include "modules/hough_segmenter/top_patches.h"

#include <algorithm>

#include "modules/geometry/convex_hull.h"
#include "modules/geometry/image_components.h"

namespace declutter {
namespace {

std::vector<Eigen::Vector2f> Hull(const std::vector<Eigen::Vector2f>& points) {
  std::vector<Eigen::Vector2d> wide;
  wide.reserve(points.size());
  for (const Eigen::Vector2f& p : points) wide.push_back(p.cast<double>());
  std::vector<Eigen::Vector2f> hull;
  for (const Eigen::Vector2d& p : ConvexHull(std::move(wide))) hull.push_back(p.cast<float>());
  return hull;
}

float Median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<TopPatch> FindTopPatches(const std::vector<TablePoint>& points, int width, int height,
                                     int thinning, float max_step_m, int min_points) {
  const int columns = (width + thinning - 1) / thinning;
  const int rows = (height + thinning - 1) / thinning;
  const auto num_pixels = static_cast<size_t>(columns) * static_cast<size_t>(rows);
  std::vector<uint8_t> mask(num_pixels, 0);
  std::vector<float> heights(num_pixels, 0);
  const auto pixel = [&](const TablePoint& point) {
    return static_cast<size_t>(point.v / thinning * columns + point.u / thinning);
  };
  for (const TablePoint& point : points) {
    if (!point.is_top()) continue;
    mask[pixel(point)] = 1;
    heights[pixel(point)] = point.p_T.z();
  }
  const ImageComponents labels = LabelComponents(columns, rows, mask, heights, max_step_m);

  std::vector<TopPatch> patches(labels.num_pixels.size());
  std::vector<std::vector<float>> patch_heights(patches.size());
  for (const TablePoint& point : points) {
    const int32_t label = labels.label[pixel(point)];
    if (label < 0 || labels.num_pixels[static_cast<size_t>(label)] < min_points) continue;
    TopPatch& patch = patches[static_cast<size_t>(label)];
    patch.component = point.component;
    patch.points.push_back(point.p_T.head<2>());
    patch_heights[static_cast<size_t>(label)].push_back(point.p_T.z());
  }
  std::vector<TopPatch> found;
  for (size_t i = 0; i < patches.size(); ++i) {
    if (patches[i].points.empty()) continue;
    patches[i].height = Median(std::move(patch_heights[i]));
    patches[i].hull = Hull(patches[i].points);
    if (patches[i].hull.size() >= 3) found.push_back(std::move(patches[i]));
  }
  return found;
}

}  // namespace declutter
