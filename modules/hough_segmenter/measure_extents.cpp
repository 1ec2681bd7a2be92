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

void Measure(const std::vector<TablePoint>& points, Face* face) {
  LineModel& line = face->model;
  std::vector<float> s_values;
  std::vector<float> z_values;
  for (const TablePoint& point : points) {
    if (point.component != face->component || !point.is_side()) continue;
    const Eigen::Vector2f p = point.p_T.head<2>();
    const float s = line.tangent().dot(p);
    if (std::abs(line.n.dot(p) - line.rho) > std::max(kMaxDistance, 2.5f * point.sigma) ||
        s < line.s_min - kMargin || s > line.s_max + kMargin ||
        line.n.dot(point.n_T.head<2>()) < kMinCos * point.n_T.head<2>().norm()) {
      continue;
    }
    s_values.push_back(s);
    z_values.push_back(point.p_T.z());
  }
  if (s_values.size() < 20) return;
  line.s_min = Quantile(&s_values, 0.005);
  line.s_max = Quantile(&s_values, 0.995);
  line.z_min = Quantile(&z_values, 0.01);
  line.z_max = Quantile(&z_values, 0.99);
}

void Measure(const std::vector<TablePoint>& points, Arc* arc) {
  CircleModel& circle = arc->model;
  std::vector<float> z_values;
  for (const TablePoint& point : points) {
    if (point.component != arc->component || !point.is_side()) continue;
    const Eigen::Vector2f q = point.p_T.head<2>() - circle.c;
    if (std::abs(q.norm() - circle.r) > std::max(kMaxDistance, 2.5f * point.sigma) ||
        point.p_T.z() < circle.z_min - kHeightMargin ||
        point.p_T.z() > circle.z_max + kHeightMargin ||
        q.dot(point.n_T.head<2>()) < kMinCos * q.norm() * point.n_T.head<2>().norm()) {
      continue;
    }
    z_values.push_back(point.p_T.z());
  }
  if (z_values.size() < 20) return;
  circle.z_min = Quantile(&z_values, 0.01);
  circle.z_max = Quantile(&z_values, 0.99);
}

}  // namespace

void MeasureExtents(const std::vector<TablePoint>& points, Surfaces* surfaces) {
  for (Face& face : surfaces->faces) Measure(points, &face);
  for (Arc& arc : surfaces->arcs) Measure(points, &arc);
}

}  // namespace declutter
