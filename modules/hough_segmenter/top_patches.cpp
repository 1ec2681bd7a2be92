#include "modules/hough_segmenter/top_patches.h"

#include <algorithm>
#include <array>
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

// The points, at least one, that are not inside the octagon of those farthest in eight directions:
// inner ones are no corners of the hull, and most are.
std::vector<Eigen::Vector2d> OuterPoints(const std::vector<Eigen::Vector2f>& points) {
  // Counter-clockwise; those of the second half are the opposites of the first.
  const std::array<Eigen::Vector2f, 4> directions = {Eigen::Vector2f(1, 0), Eigen::Vector2f(1, 1),
                                                     Eigen::Vector2f(0, 1), Eigen::Vector2f(-1, 1)};
  std::array<Eigen::Vector2f, 8> corners;
  corners.fill(points[0]);
  std::array<float, 8> farthest;
  farthest.fill(std::numeric_limits<float>::lowest());
  for (const Eigen::Vector2f& p : points) {
    for (size_t k = 0; k < directions.size(); ++k) {
      const float along = directions[k].dot(p);
      for (const auto& [corner, distance] : {std::pair(k, along), std::pair(k + 4, -along)}) {
        if (distance <= farthest[corner]) continue;
        farthest[corner] = distance;
        corners[corner] = p;
      }
    }
  }
  std::array<Eigen::Vector3f, 8> edges;  // inward normal and offset
  for (size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2f along = corners[(k + 1) % corners.size()] - corners[k];
    const Eigen::Vector2f inward(-along.y(), along.x());
    edges[k] = {inward.x(), inward.y(), -inward.dot(corners[k])};
  }
  constexpr float kMargin = 1e-7f;  // [m^2] above what rounding makes of points on an edge
  std::vector<Eigen::Vector2d> outer;
  for (const Eigen::Vector2f& p : points) {
    float least = std::numeric_limits<float>::max();
    for (const Eigen::Vector3f& edge : edges) {
      // An edge between equal corners bounds nothing.
      const float inside = edge.x() * p.x() + edge.y() * p.y() + edge.z();
      least = edge.x() == 0 && edge.y() == 0 ? least : std::min(least, inside);
    }
    if (least <= kMargin) outer.push_back(p.cast<double>());
  }
  return outer;
}

std::vector<Eigen::Vector2f> Hull(const std::vector<Eigen::Vector2f>& points) {
  std::vector<Eigen::Vector2f> hull;
  for (const Eigen::Vector2d& p : ConvexHull(OuterPoints(points))) hull.push_back(p.cast<float>());
  return hull;
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

void TopPatchFinder::DrawPoints(const std::vector<TablePoint>& points, int thinning) {
  const auto num_pixels = static_cast<size_t>(columns_) * static_cast<size_t>(rows_);
  if (is_point_.size() != num_pixels) {
    is_top_.assign(num_pixels, 0);
    is_point_.assign(num_pixels, 0);
    heights_.assign(num_pixels, 0);
    height_inside_.assign(num_pixels, 0);
  }
  pixels_.clear();
  for (const TablePoint& point : points) {
    const auto pixel = static_cast<size_t>(point.v / thinning * columns_ + point.u / thinning);
    pixels_.push_back(pixel);
    is_top_[pixel] = point.is_top();
    is_point_[pixel] = 1;
    heights_[pixel] = height_inside_[pixel] = point.p_T.z();
  }
}

void TopPatchFinder::ErasePoints() {
  for (const size_t pixel : pixels_) {
    is_top_[pixel] = is_point_[pixel] = 0;
    heights_[pixel] = height_inside_[pixel] = 0;
  }
}

bool TopPatchFinder::IsAtRim(size_t pixel) const {
  const int u = static_cast<int>(pixel) % columns_;
  const int v = static_cast<int>(pixel) / columns_;
  return u == 0 || v == 0 || u + 1 == columns_ || v + 1 == rows_;
}

// Normals bend near edges, which keeps the rim of a face out of its patch: takes in pixels around
// the patches, ring by ring, that are at the height of the nearest one inside.
void TopPatchFinder::GrowOverRims(std::vector<int32_t>* labels) {
  const auto row = static_cast<size_t>(columns_);
  const auto may_join = [&](size_t i) { return is_point_[i] && (*labels)[i] < 0 && !IsAtRim(i); };
  candidates_.clear();
  for (const size_t i : pixels_) {
    if ((*labels)[i] < 0) candidates_.push_back(i);
  }
  for (int ring = 0; ring < kRimPixels; ++ring) {
    grown_.clear();
    for (const size_t i : candidates_) {
      if (!may_join(i)) continue;
      for (const size_t j : {i - 1, i + 1, i - row, i + row}) {
        if ((*labels)[j] < 0 || std::abs(heights_[i] - height_inside_[j]) > kMaxRimStep) continue;
        grown_.emplace_back(i, j);
        break;
      }
    }
    // What did not join now can only join what has just been taken in.
    candidates_.clear();
    for (const auto& [i, j] : grown_) {
      (*labels)[i] = (*labels)[j];
      height_inside_[i] = height_inside_[j];
      candidates_.insert(candidates_.end(), {i - 1, i + 1, i - row, i + row});
    }
  }
}

std::vector<TopPatch> TopPatchFinder::Find(const std::vector<TablePoint>& points,
                                           const Tabletop& tabletop, const Eigen::Isometry3d& X_TC,
                                           float max_step_m, int min_points) {
  const int thinning = tabletop.thinning;
  columns_ = (tabletop.objects.camera.width + thinning - 1) / thinning;
  rows_ = (tabletop.objects.camera.height + thinning - 1) / thinning;
  DrawPoints(points, thinning);
  ImageComponents labels = LabelComponents(columns_, rows_, is_top_, heights_, max_step_m);
  SplitAtHeights(columns_, rows_, heights_, max_step_m, min_points, &labels);
  for (const size_t pixel : pixels_) {
    int32_t& label = labels.label[pixel];
    if (label >= 0 && labels.num_pixels[static_cast<size_t>(label)] < min_points) label = -1;
  }
  GrowOverRims(&labels.label);
  ErasePoints();

  std::vector<TopPatch> patches(labels.num_pixels.size());
  std::vector<std::vector<float>> patch_heights(patches.size());
  for (size_t k = 0; k < points.size(); ++k) {
    const int32_t label = labels.label[pixels_[k]];
    if (label < 0) continue;
    const TablePoint& point = points[k];
    TopPatch& patch = patches[static_cast<size_t>(label)];
    patch.component = point.component;
    patch.points.push_back(point.p_T.head<2>());
    patch.sigma = std::max(patch.sigma, point.sigma);
    patch_heights[static_cast<size_t>(label)].push_back(point.p_T.z());
  }
  for (size_t i = 0; i < patches.size(); ++i) {
    if (!patches[i].points.empty()) patches[i].height = Quantile(&patch_heights[i], 0.5);
  }
  AddFreeEdges(tabletop, X_TC, labels.label, pixels_, &patches);
  std::vector<TopPatch> found;
  for (TopPatch& patch : patches) {
    if (patch.points.empty()) continue;
    patch.hull = Hull(patch.points);
    if (patch.hull.size() >= 3) found.push_back(std::move(patch));
  }
  return found;
}

}  // namespace declutter
