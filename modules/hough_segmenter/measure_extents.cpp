#include <algorithm>
#include <cmath>

#include "modules/hough_segmenter/quantile.h"
#include "modules/hough_segmenter/solid_completion.h"

namespace declutter {
namespace {

constexpr float kMaxDistance = 0.004f;   // [m] of a point from the surface it is measured with
constexpr float kMargin = 0.006f;        // [m] around the extent found on cells
constexpr float kHeightMargin = 0.014f;  // [m] half a cell more
constexpr float kMinCos = 0.7f;          // normals bend near outlines

}  // namespace

void SolidCompletion::Measure(const PointGrid& sides, Face* face) {
  LineModel& line = face->model;
  const float reach = std::max(kMaxDistance, 2.5f * sides.max_sigma());
  Eigen::AlignedBox2f box(line.PointAt(line.s_min - kMargin));
  box.extend(line.PointAt(line.s_max + kMargin));
  const Eigen::Vector2f margin = Eigen::Vector2f::Constant(reach);
  s_values_.clear();
  z_values_.clear();
  sides.ForEachIn(
      {box.min() - margin, box.max() + margin},
      [&](const Eigen::Vector2f& middle) {
        return std::abs(line.n.dot(middle) - line.rho) < reach + PointGrid::kHalfDiagonal;
      },
      [&](const SurfacePoint& point) {
        if (point.component != face->component) return;
        const Eigen::Vector2f p = point.p_T.head<2>();
        const float s = line.tangent().dot(p);
        if (std::abs(line.n.dot(p) - line.rho) > std::max(kMaxDistance, 2.5f * point.sigma) ||
            s < line.s_min - kMargin || s > line.s_max + kMargin ||
            line.n.dot(point.n_T.head<2>()) < kMinCos * point.n_T.head<2>().norm()) {
          return;
        }
        s_values_.push_back(s);
        z_values_.push_back(point.p_T.z());
      });
  if (s_values_.size() < 20) return;
  const Range s_range = Quantiles(&s_values_, 0.005, 0.995);
  const Range z_range = Quantiles(&z_values_, 0.01, 0.99);
  line.s_min = s_range.low;
  line.s_max = s_range.high;
  line.z_min = z_range.low;
  line.z_max = z_range.high;
}

void SolidCompletion::Measure(const PointGrid& sides, Arc* arc) {
  CircleModel& circle = arc->model;
  const float reach = std::max(kMaxDistance, 2.5f * sides.max_sigma());
  const Eigen::Vector2f half = Eigen::Vector2f::Constant(circle.r + reach);
  z_values_.clear();
  sides.ForEachIn(
      {circle.c - half, circle.c + half},
      [&](const Eigen::Vector2f& middle) {
        return std::abs((middle - circle.c).norm() - circle.r) < reach + PointGrid::kHalfDiagonal;
      },
      [&](const SurfacePoint& point) {
        if (point.component != arc->component) return;
        const Eigen::Vector2f q = point.p_T.head<2>() - circle.c;
        if (std::abs(q.norm() - circle.r) > std::max(kMaxDistance, 2.5f * point.sigma) ||
            point.p_T.z() < circle.z_min - kHeightMargin ||
            point.p_T.z() > circle.z_max + kHeightMargin ||
            q.dot(point.n_T.head<2>()) < kMinCos * q.norm() * point.n_T.head<2>().norm()) {
          return;
        }
        z_values_.push_back(point.p_T.z());
      });
  if (z_values_.size() < 20) return;
  const Range z_range = Quantiles(&z_values_, 0.01, 0.99);
  circle.z_min = z_range.low;
  circle.z_max = z_range.high;
}

void SolidCompletion::MeasureExtents(const PointGrid& sides, SideDetections* detections) {
  for (Face& face : detections->faces) Measure(sides, &face);
  for (Arc& arc : detections->arcs) Measure(sides, &arc);
}

}  // namespace declutter
