#include "modules/hough_segmenter/top_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "modules/geometry/convex_hull.h"
#include "modules/hough_segmenter/free_edges.h"
#include "modules/hough_segmenter/quantile.h"

namespace declutter {
namespace {

constexpr int kRimPixels = 4;  // [px] of the image that normals are blurred over
// In height between a rim and the face inside: [m], and where noise makes more, sigma.
constexpr float kMaxRimStep = 0.003f;
constexpr float kMaxRimSigmas = 2;

template <size_t kNum>
std::array<Eigen::Vector2f, kNum> EveryDegree() {
  std::array<Eigen::Vector2f, kNum> directions;
  for (size_t degree = 0; degree < kNum; ++degree) {
    const auto angle = static_cast<float>(static_cast<int>(degree) * M_PI / 180);
    directions[degree] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}

// Sets outer to the points, at least one, that are not inside the octagon of those farthest in
// eight directions: inner ones are no corners of the hull, and most are.
void FindOuterPoints(const PlanarPoints& points, std::vector<Eigen::Vector2d>* outer) {
  // Counter-clockwise; those of the second half are the opposites of the first.
  const std::array<Eigen::Vector2f, 4> directions = {Eigen::Vector2f(1, 0), Eigen::Vector2f(1, 1),
                                                     Eigen::Vector2f(0, 1), Eigen::Vector2f(-1, 1)};
  std::array<Eigen::Vector2f, 8> corners;
  corners.fill(points[0]);
  std::array<float, 8> farthest;
  farthest.fill(std::numeric_limits<float>::lowest());
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2f p = points[i];
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
  outer->clear();
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2f p = points[i];
    float least = std::numeric_limits<float>::max();
    for (const Eigen::Vector3f& edge : edges) {
      // An edge between equal corners bounds nothing.
      const float inside = edge.x() * p.x() + edge.y() * p.y() + edge.z();
      least = edge.x() == 0 && edge.y() == 0 ? least : std::min(least, inside);
    }
    if (least <= kMargin) outer->push_back(p.cast<double>());
  }
}

}  // namespace

Eigen::Vector2f MinimumAreaAxis(const TopPatch& patch) {
  static const std::array<Eigen::Vector2f, 90> axes = EveryDegree<90>();
  Eigen::Vector2f best = Eigen::Vector2f::UnitX();
  float best_area = std::numeric_limits<float>::max();
  for (const Eigen::Vector2f& axis : axes) {
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
  if (labels_.size() != num_pixels) {
    is_top_.assign(num_pixels, 0);
    is_point_.assign(num_pixels, 0);
    labels_.assign(num_pixels, -1);
    heights_.assign(num_pixels, 0);
    height_inside_.assign(num_pixels, 0);
    max_rim_step_.assign(num_pixels, 0);
  }
  pixels_.clear();
  for (const TablePoint& point : points) {
    const auto pixel = static_cast<size_t>(point.v / thinning * columns_ + point.u / thinning);
    pixels_.push_back(pixel);
    is_top_[pixel] = point.is_top();
    is_point_[pixel] = 1;
    heights_[pixel] = point.p_T.z();
    max_rim_step_[pixel] = std::max(kMaxRimStep, kMaxRimSigmas * point.sigma);
  }
}

void TopPatchFinder::ErasePoints() {
  for (const size_t pixel : pixels_) {
    is_top_[pixel] = is_point_[pixel] = 0;
    labels_[pixel] = -1;
  }
}

void TopPatchFinder::DrawComponents(int min_pixels) {
  for (const ComponentRun& run : components_.runs) {
    const bool is_large = components_.num_pixels[static_cast<size_t>(run.component)] >= min_pixels;
    const auto begin = static_cast<std::ptrdiff_t>(run.begin);
    const auto end = static_cast<std::ptrdiff_t>(run.end);
    std::fill(labels_.begin() + begin, labels_.begin() + end, is_large ? run.component : -1);
    std::copy(heights_.begin() + begin, heights_.begin() + end, height_inside_.begin() + begin);
  }
}

bool TopPatchFinder::IsAtRim(size_t pixel) const {
  const int u = static_cast<int>(pixel) % columns_;
  const int v = static_cast<int>(pixel) / columns_;
  return u == 0 || v == 0 || u + 1 == columns_ || v + 1 == rows_;
}

// Normals bend near edges, which keeps the rim of a face out of its patch: takes in pixels around
// the patches, ring by ring, that are at the height of the nearest one inside.
void TopPatchFinder::GrowOverRims() {
  const auto row = static_cast<size_t>(columns_);
  candidates_.clear();
  const auto add_neighbours = [&](size_t i) {
    for (const size_t j : {i - 1, i + 1, i - row, i + row}) {
      if (j < labels_.size() && is_point_[j] && labels_[j] < 0) candidates_.push_back(j);
    }
  };
  for (const ComponentRun& run : components_.runs) {
    if (labels_[run.begin] < 0) continue;
    for (size_t i = run.begin; i < run.end; ++i) add_neighbours(i);
  }
  for (int ring = 0; ring < kRimPixels; ++ring) {
    grown_.clear();
    for (const size_t i : candidates_) {
      if (IsAtRim(i)) continue;
      for (const size_t j : {i - 1, i + 1, i - row, i + row}) {
        if (labels_[j] < 0 || std::abs(heights_[i] - height_inside_[j]) > max_rim_step_[i])
          continue;
        grown_.emplace_back(i, j);
        break;
      }
    }
    // What did not join now can only join what has just been taken in.
    candidates_.clear();
    for (const auto& [i, j] : grown_) {
      labels_[i] = labels_[j];
      height_inside_[i] = height_inside_[j];
    }
    for (const auto& [i, j] : grown_) add_neighbours(i);
  }
}

void TopPatchFinder::GatherPatches(const std::vector<TablePoint>& points) {
  patches_.Clear();
  patch_heights_.Clear();
  for (size_t i = 0; i < components_.num_pixels.size(); ++i) {
    TopPatch& patch = patches_.Add();
    patch.points.Clear();
    patch.hull.clear();
    patch.free_edge.clear();
    patch.sigma = 0;
    patch_heights_.Add().clear();
  }
  for (size_t k = 0; k < points.size(); ++k) {
    const int32_t label = labels_[pixels_[k]];
    if (label < 0) continue;
    const TablePoint& point = points[k];
    TopPatch& patch = patches_[static_cast<size_t>(label)];
    patch.component = point.component;
    patch.points.Add(point.p_T.head<2>());
    patch.sigma = std::max(patch.sigma, point.sigma);
    patch_heights_[static_cast<size_t>(label)].push_back(point.p_T.z());
  }
  for (size_t i = 0; i < patches_.size(); ++i) {
    if (!patches_[i].points.empty()) patches_[i].height = Quantile(&patch_heights_[i], 0.5);
  }
}

void TopPatchFinder::SetHull(TopPatch* patch) {
  FindOuterPoints(patch->points, &outer_points_);
  ConvexHull(&outer_points_, &hull_);
  for (const Eigen::Vector2d& p : hull_) patch->hull.push_back(p.cast<float>());
}

const TopPatches& TopPatchFinder::Find(const std::vector<TablePoint>& points,
                                       const Tabletop& tabletop, const Eigen::Isometry3d& X_TC,
                                       float max_step_m, int min_points) {
  const int thinning = tabletop.thinning;
  columns_ = (tabletop.objects.camera.width + thinning - 1) / thinning;
  rows_ = (tabletop.objects.camera.height + thinning - 1) / thinning;
  DrawPoints(points, thinning);
  components_ =
      FindComponents(columns_, rows_, is_top_, heights_, max_step_m, std::move(components_));
  DrawComponents(0);
  bands_.Split(columns_, rows_, is_top_, heights_, max_step_m, min_points, labels_, &components_);
  DrawComponents(min_points);
  GrowOverRims();
  GatherPatches(points);
  AddFreeEdges(tabletop, X_TC, labels_, pixels_, &patches_);
  ErasePoints();
  size_t num_found = 0;
  for (TopPatch& patch : patches_) {
    if (patch.points.empty()) continue;
    SetHull(&patch);
    if (patch.hull.size() >= 3) std::swap(patches_[num_found++], patch);
  }
  while (patches_.size() > num_found) patches_.RemoveLast();
  return patches_;
}

}  // namespace declutter
