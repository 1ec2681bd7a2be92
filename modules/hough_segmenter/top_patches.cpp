#include "modules/hough_segmenter/top_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/geometry/convex_hull.h"
#include "modules/geometry/image_components.h"
#include "modules/hough_segmenter/free_edges.h"
#include "modules/hough_segmenter/height_bands.h"
#include "modules/hough_segmenter/quantile.h"

namespace declutter {
namespace {

constexpr int kRimPixels = 4;          // [px] of the image that normals are blurred over
constexpr float kMaxRimStep = 0.003f;  // [m] in height between a rim and the face inside

std::vector<Eigen::Vector2f> Hull(const std::vector<Eigen::Vector2f>& points) {
  std::vector<Eigen::Vector2d> wide;
  wide.reserve(points.size());
  for (const Eigen::Vector2f& p : points) wide.push_back(p.cast<double>());
  std::vector<Eigen::Vector2f> hull;
  for (const Eigen::Vector2d& p : ConvexHull(std::move(wide))) hull.push_back(p.cast<float>());
  return hull;
}

// Normals bend near edges, which keeps the rim of a face out of its patch: takes in pixels around
// the patches, ring by ring, that are at the height of the nearest one inside.
void GrowOverRims(const std::vector<uint8_t>& is_point, const std::vector<float>& heights,
                  int columns, int rows, std::vector<int32_t>* labels) {
  std::vector<float> height_inside = heights;
  for (int ring = 0; ring < kRimPixels; ++ring) {
    std::vector<std::pair<size_t, size_t>> grown;  // pixel, neighbour that it joins
    for (int v = 1; v + 1 < rows; ++v) {
      for (int u = 1; u + 1 < columns; ++u) {
        const auto i = static_cast<size_t>(v * columns + u);
        if (!is_point[i] || (*labels)[i] >= 0) continue;
        for (size_t j :
             {i - 1, i + 1, i - static_cast<size_t>(columns), i + static_cast<size_t>(columns)}) {
          if ((*labels)[j] < 0 || std::abs(heights[i] - height_inside[j]) > kMaxRimStep) continue;
          grown.emplace_back(i, j);
          break;
        }
      }
    }
    for (const auto& [i, j] : grown) {
      (*labels)[i] = (*labels)[j];
      height_inside[i] = height_inside[j];
    }
  }
}

}  // namespace

Eigen::Vector2f MinimumAreaAxis(const TopPatch& patch) {
  Eigen::Vector2f best = Eigen::Vector2f::UnitX();
  float best_area = std::numeric_limits<float>::max();
  for (int degree = 0; degree < 90; ++degree) {
    const float angle = static_cast<float>(degree * M_PI / 180);
    const Eigen::Vector2f axis(std::cos(angle), std::sin(angle));
    const Eigen::Vector2f other(-axis.y(), axis.x());
    Eigen::Vector2f low = Eigen::Vector2f::Constant(std::numeric_limits<float>::max());
    Eigen::Vector2f high = -low;
    for (const Eigen::Vector2f& p : patch.hull) {
      const Eigen::Vector2f q(axis.dot(p), other.dot(p));
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
    const float area = (high - low).prod();
    if (area < best_area) {
      best_area = area;
      best = axis;
    }
  }
  return best;
}

std::vector<TopPatch> FindTopPatches(const std::vector<TablePoint>& points,
                                     const Tabletop& tabletop, const Eigen::Isometry3d& X_TC,
                                     float max_step_m, int min_points) {
  const int thinning = tabletop.thinning;
  const int columns = (tabletop.objects.camera.width + thinning - 1) / thinning;
  const int rows = (tabletop.objects.camera.height + thinning - 1) / thinning;
  const auto num_pixels = static_cast<size_t>(columns) * static_cast<size_t>(rows);
  std::vector<uint8_t> mask(num_pixels, 0);
  std::vector<uint8_t> is_point(num_pixels, 0);
  std::vector<float> heights(num_pixels, 0);
  const auto pixel = [&](const TablePoint& point) {
    return static_cast<size_t>(point.v / thinning * columns + point.u / thinning);
  };
  for (const TablePoint& point : points) {
    mask[pixel(point)] = point.is_top();
    is_point[pixel(point)] = 1;
    heights[pixel(point)] = point.p_T.z();
  }
  ImageComponents labels = LabelComponents(columns, rows, mask, heights, max_step_m);
  SplitAtHeights(columns, rows, heights, max_step_m, min_points, &labels);
  for (int32_t& label : labels.label) {
    if (label >= 0 && labels.num_pixels[static_cast<size_t>(label)] < min_points) label = -1;
  }
  GrowOverRims(is_point, heights, columns, rows, &labels.label);

  std::vector<TopPatch> patches(labels.num_pixels.size());
  std::vector<std::vector<float>> patch_heights(patches.size());
  for (const TablePoint& point : points) {
    const int32_t label = labels.label[pixel(point)];
    if (label < 0) continue;
    TopPatch& patch = patches[static_cast<size_t>(label)];
    patch.component = point.component;
    patch.points.push_back(point.p_T.head<2>());
    patch.sigma = std::max(patch.sigma, point.sigma);
    patch_heights[static_cast<size_t>(label)].push_back(point.p_T.z());
  }
  for (size_t i = 0; i < patches.size(); ++i) {
    if (!patches[i].points.empty()) patches[i].height = Quantile(&patch_heights[i], 0.5);
  }
  AddFreeEdges(tabletop, X_TC, labels.label, &patches);
  std::vector<TopPatch> found;
  for (size_t i = 0; i < patches.size(); ++i) {
    if (patches[i].points.empty()) continue;
    patches[i].hull = Hull(patches[i].points);
    if (patches[i].hull.size() >= 3) found.push_back(std::move(patches[i]));
  }
  return found;
}

}  // namespace declutter
