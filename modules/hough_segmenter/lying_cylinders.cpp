#include "modules/hough_segmenter/lying_cylinders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "modules/hough_segmenter/quantile.h"
#include "modules/hough_segmenter/side_voting.h"

namespace declutter {
namespace {

constexpr float kMinRoundShare = 0.30f;  // of the points below a top whose normals are in between
constexpr float kMaxAxialNormal = 0.5f;  // of a normal on the side of a cylinder, along its axis
constexpr float kMinArc = 1.0f;          // [rad] of the circle that must be seen
constexpr int kMaxIterations = 8;        // a surface cut out for one cylinder needs few
constexpr float kMaxSink = 0.012f;       // [m] of a cylinder into the support plane

// The vertical frame L across a horizontal axis: x = horizontal, y = up, z = along the axis.
struct CrossSection {
  Eigen::Vector2f axis;  // unit, in the xy plane of T

  Eigen::Vector2f across() const { return {axis.y(), -axis.x()}; }
  Eigen::Vector3f FromT(const Eigen::Vector3f& x_T) const {
    return {across().dot(x_T.head<2>()), x_T.z(), axis.dot(x_T.head<2>())};
  }
};

// Points around and below a top patch, in L, without those on the ends of a cylinder along the
// axis.
std::vector<TablePoint> PointsInSection(const std::vector<TablePoint>& points,
                                        const TopPatch& patch, const CrossSection& section,
                                        float reach) {
  float a_min = std::numeric_limits<float>::max(), a_max = -a_min;
  float b_min = a_min, b_max = a_max;
  for (const Eigen::Vector2f& p : patch.hull) {
    a_min = std::min(a_min, section.axis.dot(p));
    a_max = std::max(a_max, section.axis.dot(p));
    b_min = std::min(b_min, section.across().dot(p));
    b_max = std::max(b_max, section.across().dot(p));
  }
  std::vector<TablePoint> selected;
  for (const TablePoint& point : points) {
    if (point.component != patch.component) continue;
    const Eigen::Vector3f p_L = section.FromT(point.p_T);
    const Eigen::Vector3f n_L = section.FromT(point.n_T);
    if (p_L.z() < a_min || p_L.z() > a_max || p_L.x() < b_min - reach || p_L.x() > b_max + reach ||
        p_L.y() > patch.height + 0.01f || std::abs(n_L.z()) > kMaxAxialNormal) {
      continue;
    }
    TablePoint in_section = point;
    in_section.p_T = p_L;
    in_section.n_T = n_L;
    in_section.component = 0;
    in_section.kappa = 0;
    selected.push_back(in_section);
  }
  return selected;
}

// On a box nearly all normals are horizontal or vertical; around a cylinder they are spread.
bool IsRound(const std::vector<TablePoint>& points_L, int min_points) {
  int num_between = 0;
  for (const TablePoint& point : points_L) {
    num_between += point.n_T.y() > 0.4f && point.n_T.y() < 0.9f;
  }
  return static_cast<int>(points_L.size()) >= min_points &&
         static_cast<float>(num_between) > kMinRoundShare * static_cast<float>(points_L.size());
}

Hypothesis MakeHypothesis(const Arc& arc, const CrossSection& section, const TopPatch& patch) {
  const CircleModel& circle = arc.model;
  Hypothesis hypothesis;
  const float middle = 0.5f * (circle.z_min + circle.z_max);
  const Eigen::Vector2f p = circle.c.x() * section.across() + middle * section.axis;
  const Eigen::Vector3d z(section.axis.x(), section.axis.y(), 0);
  hypothesis.solid.shape = Shape::kCylinder;
  hypothesis.solid.X_CO.linear().col(0) = Eigen::Vector3d::UnitZ();
  hypothesis.solid.X_CO.linear().col(1) = z.cross(Eigen::Vector3d::UnitZ());
  hypothesis.solid.X_CO.linear().col(2) = z;
  hypothesis.solid.X_CO.translation() = Eigen::Vector3d(p.x(), p.y(), circle.c.y());
  hypothesis.solid.size = Eigen::Vector3d(2 * circle.r, 2 * circle.r, circle.z_max - circle.z_min);
  hypothesis.component = patch.component;
  hypothesis.num_votes = arc.num_votes;
  hypothesis.num_inliers = arc.num_points;
  hypothesis.score = arc.agreement;
  return hypothesis;
}

// Ends along the axis from the points on the circle, where the cells only give their centres.
void MeasureEnds(const std::vector<TablePoint>& points_L, CircleModel* circle) {
  std::vector<float> along;
  for (const TablePoint& point : points_L) {
    const float distance = (point.p_T.head<2>() - circle->c).norm();
    if (std::abs(distance - circle->r) < std::max(0.005f, 3 * point.sigma)) {
      along.push_back(point.p_T.z());
    }
  }
  if (along.size() < 20) return;
  circle->z_min = Quantile(&along, 0.005);
  circle->z_max = Quantile(&along, 0.995);
}

// Two visible parts of one cylinder with an occluder between them, as one; nothing when they are
// not on one axis. The line through both centres gives the axis better than either part.
std::optional<Hypothesis> Join(const Hypothesis& a, const Hypothesis& b, double max_length) {
  constexpr double kMaxOffset = 0.012;  // [m] between the heights and between the radii
  constexpr double kMinCos = 0.97;      // of the axis of a part and that through both
  Eigen::Vector3d ab = b.solid.X_CO.translation() - a.solid.X_CO.translation();
  if (std::abs(ab.z()) > kMaxOffset || std::abs(a.solid.radius() - b.solid.radius()) > kMaxOffset) {
    return std::nullopt;
  }
  ab.z() = 0;
  const double distance = ab.norm();
  const Eigen::Vector3d axis = ab / distance;
  if (!(std::abs(axis.dot(a.solid.X_CO.linear().col(2))) > kMinCos) ||
      !(std::abs(axis.dot(b.solid.X_CO.linear().col(2))) > kMinCos)) {
    return std::nullopt;
  }
  const double low = std::min(-0.5 * a.solid.height(), distance - 0.5 * b.solid.height());
  const double high = std::max(0.5 * a.solid.height(), distance + 0.5 * b.solid.height());
  if (high - low > max_length) return std::nullopt;
  Hypothesis joined = a;
  joined.solid.X_CO.linear() << Eigen::Vector3d::UnitZ(), axis.cross(Eigen::Vector3d::UnitZ()),
      axis;
  joined.solid.X_CO.translation() += 0.5 * (low + high) * axis;
  const double diameter = a.solid.radius() + b.solid.radius();
  joined.solid.size = Eigen::Vector3d(diameter, diameter, high - low);
  joined.num_votes += b.num_votes;
  joined.num_inliers += b.num_inliers;
  return joined;
}

void AddJoined(double max_length, std::vector<Hypothesis>* hypotheses) {
  const size_t num = hypotheses->size();
  for (size_t i = 0; i < num; ++i) {
    for (size_t j = i + 1; j < num; ++j) {
      const auto joined = Join((*hypotheses)[i], (*hypotheses)[j], max_length);
      if (joined) hypotheses->push_back(*joined);
    }
  }
}

}  // namespace

HoughSegmenterConfig SectionConfig(const HoughSegmenterConfig& config) {
  HoughSegmenterConfig section_config = config;
  section_config.set_num_iterations(std::min(config.num_iterations(), kMaxIterations));
  // Curvature is known along horizontal tangents only: here positions and normals decide alone.
  section_config.set_filter_curvature(false);
  section_config.set_filter_radius(false);
  return section_config;
}

std::vector<Hypothesis> FindLyingCylinders(const HoughSegmenterConfig& config,
                                           const std::vector<TablePoint>& points,
                                           const std::vector<TopPatch>& tops, SideSearch* search) {
  const auto max_radius = static_cast<float>(config.max_radius_m());
  std::vector<Hypothesis> hypotheses;
  for (const TopPatch& patch : tops) {
    const Eigen::Vector2f long_axis = MinimumAreaAxis(patch);
    for (const CrossSection& section :
         {CrossSection{long_axis}, CrossSection{{-long_axis.y(), long_axis.x()}}}) {
      const std::vector<TablePoint> points_L = PointsInSection(points, patch, section, max_radius);
      if (!IsRound(points_L, config.min_inliers())) continue;
      const auto cells = SideCells(points_L, 1, static_cast<float>(config.cell_side_m()),
                                   static_cast<float>(config.cell_height_m()));
      SideDetections detections;
      search->fitter.Assign(FeatureMode::kDefault, cells[0], config.seed());
      DetectSides(patch.component, search, &detections);
      for (Arc& arc : detections.arcs) {
        if (arc.model.arc < kMinArc || arc.model.c.y() - arc.model.r < -kMaxSink) continue;
        MeasureEnds(points_L, &arc.model);
        hypotheses.push_back(MakeHypothesis(arc, section, patch));
      }
    }
  }
  AddJoined(config.max_box_extent_m(), &hypotheses);
  return hypotheses;
}

}  // namespace declutter
