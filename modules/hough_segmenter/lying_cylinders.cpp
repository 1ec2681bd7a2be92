#include "modules/hough_segmenter/lying_cylinders.h"

#include <algorithm>
#include <cmath>
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

// The parameters of votes in vertical planes.
HoughSegmenterConfig SectionConfig(const HoughSegmenterConfig& config) {
  HoughSegmenterConfig section_config = config;
  section_config.set_num_iterations(std::min(config.num_iterations(), kMaxIterations));
  // Curvature is known along horizontal tangents only: here positions and normals decide alone.
  section_config.set_filter_curvature(false);
  section_config.set_filter_radius(false);
  return section_config;
}

// The vertical frame L across a horizontal axis: x = horizontal, y = up, z = along the axis.
struct CrossSection {
  Eigen::Vector2f axis;  // unit, in the xy plane of T

  Eigen::Vector2f across() const { return {axis.y(), -axis.x()}; }
  Eigen::Vector3f FromT(const Eigen::Vector3f& x_T) const {
    return {across().dot(x_T.head<2>()), x_T.z(), axis.dot(x_T.head<2>())};
  }
};

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

// Appends what comes of joining two of the hypotheses from the first on.
void AddJoined(size_t first, double max_length, std::vector<Hypothesis>* hypotheses) {
  const size_t num = hypotheses->size();
  for (size_t i = first; i < num; ++i) {
    for (size_t j = i + 1; j < num; ++j) {
      const auto joined = Join((*hypotheses)[i], (*hypotheses)[j], max_length);
      if (joined) hypotheses->push_back(*joined);
    }
  }
}

}  // namespace

// What lies around and below a top patch, without what is on the ends of a cylinder along the axis.
class LyingCylinders::Section {
 public:
  Section(const TopPatch& patch, const CrossSection& frame, float reach)
      : patch_(patch), frame_(frame) {
    Eigen::AlignedBox2f box_L;
    for (const Eigen::Vector2f& p : patch.hull) {
      box_L.extend(Eigen::Vector2f(frame.across().dot(p), frame.axis.dot(p)));
      box_T_.extend(p);
    }
    const Eigen::Vector2f margin = Eigen::Vector2f::Constant(reach);
    box_T_ = {box_T_.min() - margin, box_T_.max() + margin};
    low_ = box_L.min() - Eigen::Vector2f(reach, 0);
    high_ = box_L.max() + Eigen::Vector2f(reach, 0);
  }

  // Around all of it, in the xy plane of T.
  const Eigen::AlignedBox2f& box_T() const { return box_T_; }

  bool Contains(const SurfacePoint& point) const {
    if (point.component != patch_.component || point.p_T.z() > patch_.height + 0.01f) return false;
    const float x = frame_.across().dot(point.p_T.head<2>());
    const float z = frame_.axis.dot(point.p_T.head<2>());
    return x >= low_.x() && x <= high_.x() && z >= low_.y() && z <= high_.y() &&
           std::abs(frame_.axis.dot(point.n_T.head<2>())) <= kMaxAxialNormal;
  }

  TablePoint InFrame(TablePoint point) const {
    point.p_T = frame_.FromT(point.p_T);
    point.n_T = frame_.FromT(point.n_T);
    point.component = 0;
    point.kappa = 0;
    return point;
  }

 private:
  const TopPatch& patch_;
  CrossSection frame_;
  Eigen::AlignedBox2f box_T_;
  Eigen::Vector2f low_;   // [m] in x and z of L
  Eigen::Vector2f high_;  // [m]
};

LyingCylinders::LyingCylinders(const HoughSegmenterConfig& config)
    : config_(config), search_(SectionConfig(config)) {}

void LyingCylinders::SortByComponent(const std::vector<TablePoint>& points) {
  component_.clear();
  int num_components = 0;
  for (const TablePoint& point : points) {
    component_.push_back(point.component);
    num_components = std::max(num_components, point.component + 1);
  }
  // first_[c + 2] counts, then begins, and at last first_[c + 1] ends the points of component c.
  first_.assign(static_cast<size_t>(num_components) + 2, 0);
  for (const int component : component_) ++first_[static_cast<size_t>(component) + 2];
  for (size_t c = 2; c < first_.size(); ++c) first_[c] += first_[c - 1];
  by_component_.resize(points.size());
  for (size_t k = 0; k < points.size(); ++k) {
    by_component_[first_[static_cast<size_t>(component_[k]) + 1]++] = static_cast<uint32_t>(k);
  }
}

// On a box nearly all normals are horizontal or vertical, around a cylinder they are spread.
bool LyingCylinders::FindRoundPoints(const std::vector<TablePoint>& points, const PointGrid& slants,
                                     const TopPatch& patch, const Section& section) {
  constexpr float kShareOfTop = 0.8f;  // of the points of a patch that are surely in the section
  float num_slanted = 0;
  slants.ForEachIn(section.box_T(), [&](const SurfacePoint& point) {
    if (section.Contains(point)) ++num_slanted;
  });
  const auto is_round = [&](float num_points) { return num_slanted > kMinRoundShare * num_points; };
  if (!is_round(kShareOfTop * static_cast<float>(patch.points.size()))) return false;
  points_L_.clear();
  const auto component = static_cast<size_t>(patch.component);
  for (uint32_t k = first_[component]; k < first_[component + 1]; ++k) {
    const TablePoint& point = points[by_component_[k]];
    if (!section.Contains(point)) continue;
    points_L_.push_back(section.InFrame(point));
    if (!is_round(static_cast<float>(points_L_.size()))) return false;
  }
  return !points_L_.empty() && static_cast<int>(points_L_.size()) >= config_.min_inliers();
}

void LyingCylinders::MeasureEnds(CircleModel* circle) {
  along_.clear();
  for (const TablePoint& point : points_L_) {
    const float distance = (point.p_T.head<2>() - circle->c).norm();
    if (std::abs(distance - circle->r) < std::max(0.005f, 3 * point.sigma)) {
      along_.push_back(point.p_T.z());
    }
  }
  if (along_.size() < 20) return;
  const Range ends = Quantiles(&along_, 0.005, 0.995);
  circle->z_min = ends.low;
  circle->z_max = ends.high;
}

void LyingCylinders::Find(const std::vector<TablePoint>& points, const PointGrid& slants,
                          const TopPatches& tops, SideCells* side_cells,
                          std::vector<Hypothesis>* hypotheses) {
  const auto max_radius = static_cast<float>(config_.max_radius_m());
  const size_t first = hypotheses->size();
  SortByComponent(points);
  for (const TopPatch& patch : tops) {
    const Eigen::Vector2f long_axis = MinimumAreaAxis(patch);
    for (const CrossSection& section :
         {CrossSection{long_axis}, CrossSection{{-long_axis.y(), long_axis.x()}}}) {
      if (!FindRoundPoints(points, slants, patch, Section(patch, section, max_radius))) continue;
      const auto& cells =
          side_cells->Gather(points_L_, 1, static_cast<float>(config_.cell_side_m()),
                             static_cast<float>(config_.cell_height_m()));
      detections_.Clear();
      search_.fitter.Assign(FeatureMode::kDefault, cells[0], config_.seed());
      DetectSides(patch.component, &search_, &detections_);
      for (Arc& arc : detections_.arcs) {
        if (arc.model.arc < kMinArc || arc.model.c.y() - arc.model.r < -kMaxSink) continue;
        MeasureEnds(&arc.model);
        hypotheses->push_back(MakeHypothesis(arc, section, patch));
      }
    }
  }
  AddJoined(first, config_.max_box_extent_m(), hypotheses);
}

}  // namespace declutter
