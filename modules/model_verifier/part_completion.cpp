#include "modules/model_verifier/part_completion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "modules/geometry/edge_direction.h"
#include "modules/geometry/quantile.h"
#include "modules/model_verifier/extents.h"

namespace declutter {
namespace {

constexpr size_t kMinTops = 12;  // points that tell the height of a top
constexpr size_t kMinSides = 6;  // points that tell how far down a side goes
constexpr float kMinRadius = 0.015f;
constexpr float kMaxRadius = 0.15f;
constexpr float kTopOnlyDepth = 0.005f;  // [m] of side below a top of which none is seen
constexpr float kMaxUnseen = 0.020f;     // [m] of side above the support

struct Range {
  float low, high;

  float length() const { return high - low; }
};

// Where the body of a part may end along an axis: where the part does, or on either side of what is
// too thin to be all of it.
struct PossibleEnds {
  std::array<Range, 2> ranges;
  size_t num;

  bool is_assumed() const { return num > 1; }
};

Range Quantiles(std::vector<float>* values, float low, float high) {
  const float a = Quantile(values, low);
  return {a, Quantile(values, high)};
}

void SetToHeights(const std::vector<Eigen::Vector3f>& points, std::vector<float>* heights) {
  heights->clear();
  for (const Eigen::Vector3f& p : points) heights->push_back(p.z());
}

// From the support, or the lowest point seen, to the top. The last two are buffers.
Range HeightsOf(const SurfacePart& part, std::vector<float>* top_heights,
                std::vector<float>* side_heights) {
  std::vector<float>& tops = *top_heights;
  std::vector<float>& sides = *side_heights;
  SetToHeights(part.tops, &tops);
  SetToHeights(part.sides, &sides);
  Range range;
  if (tops.size() >= kMinTops) {
    range.high = Quantiles(&tops, 0.5f, 0.5f).low;
  } else {
    tops.insert(tops.end(), sides.begin(), sides.end());
    range.high = Quantiles(&tops, 0.5f, 0.98f).high;
  }
  range.low = range.high - kTopOnlyDepth;
  if (sides.size() >= kMinSides)
    range.low = std::min(range.low, Quantiles(&sides, 0.02f, 0.5f).low);
  if (range.low < kMaxUnseen) range.low = 0;
  return range;
}

Hypothesis Standing(Shape shape, const Range& heights, const Eigen::Vector2f& centre,
                    const Eigen::Vector2f& axis, const Eigen::Vector2f& size,
                    const Eigen::Isometry3d& X_CT) {
  Hypothesis hypothesis;
  hypothesis.solid.shape = shape;
  Eigen::Isometry3d X_TO = Eigen::Isometry3d::Identity();
  X_TO.linear() = Eigen::AngleAxisd(std::atan2(axis.y(), axis.x()), Eigen::Vector3d::UnitZ())
                      .toRotationMatrix();
  X_TO.translation() =
      Eigen::Vector3f(centre.x(), centre.y(), 0.5f * (heights.low + heights.high)).cast<double>();
  hypothesis.solid.X_CO = X_CT * X_TO;
  hypothesis.solid.size =
      Eigen::Vector3f(size.x(), size.y(), heights.high - heights.low).cast<double>();
  if (heights.low > 0) hypothesis.evidence[2] = Evidence::kAssumed;
  return hypothesis;
}

PossibleEnds EndsAround(const Range& seen, const Range& seen_across) {
  if (seen.length() > static_cast<float>(kMinExtent)) return {{seen, seen}, 1};
  constexpr float kDepthOfWidth = 0.5f;                  // assumed, as a share of what is seen
  constexpr float kMinDepth = 0.030f, kMaxDepth = 0.1f;  // [m]
  const float depth = std::clamp(kDepthOfWidth * seen_across.length(), kMinDepth, kMaxDepth);
  return {{Range{seen.low, seen.low + depth}, Range{seen.high - depth, seen.high}}, 2};
}

// Appends the boxes along the outline of a part that it may be the surface of. along is a buffer.
void AddBoxesOver(const SurfacePart& part, const Range& heights, const Eigen::Isometry3d& X_CT,
                  std::vector<float>* along, std::vector<Hypothesis>* boxes) {
  const auto direction = EdgeDirection(part.outline);
  if (!direction) return;
  const std::array<Eigen::Vector2f, 2> axes = {*direction, {-direction->y(), direction->x()}};
  std::array<Range, 2> seen;
  for (size_t i = 0; i < 2; ++i) {
    along->clear();
    for (const auto* points : {&part.tops, &part.sides}) {
      for (const Eigen::Vector3f& p : *points) along->push_back(axes[i].dot(p.head<2>()));
    }
    seen[i] = Quantiles(along, 0.01f, 0.99f);
  }
  const std::array<PossibleEnds, 2> ends = {EndsAround(seen[0], seen[1]),
                                            EndsAround(seen[1], seen[0])};
  for (size_t i = 0; i < ends[0].num; ++i) {
    for (size_t k = 0; k < ends[1].num; ++k) {
      const Range& x = ends[0].ranges[i];
      const Range& y = ends[1].ranges[k];
      const Eigen::Vector2f size(x.length(), y.length());
      if (size.maxCoeff() > static_cast<float>(kMaxExtent)) continue;
      const Eigen::Vector2f centre =
          0.5f * (x.low + x.high) * axes[0] + 0.5f * (y.low + y.high) * axes[1];
      Hypothesis& box =
          boxes->emplace_back(Standing(Shape::kBox, heights, centre, axes[0], size, X_CT));
      for (size_t axis = 0; axis < 2; ++axis) {
        if (ends[axis].is_assumed()) box.evidence[axis] = Evidence::kAssumed;
      }
    }
  }
}

std::optional<Hypothesis> CylinderOver(const SurfacePart& part, const Range& heights,
                                       const Eigen::Isometry3d& X_CT) {
  constexpr int kSteps = 8;
  constexpr float kMaxDistance = 0.008f;  // [m] of a point of the outline from the circle
  if (part.outline.size() < kMinTops) return std::nullopt;
  // |p|^2 = 2 c p + r^2 - |c|^2 by least squares, then distances instead of squares.
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (const Eigen::Vector2f& p : part.outline) mean += p;
  mean /= static_cast<float>(part.outline.size());
  Eigen::Matrix3f H = Eigen::Matrix3f::Identity() * 1e-7f;
  Eigen::Vector3f g = Eigen::Vector3f::Zero();
  for (const Eigen::Vector2f& p : part.outline) {
    const Eigen::Vector2f q = p - mean;
    const Eigen::Vector3f J(2 * q.x(), 2 * q.y(), 1);
    H += J * J.transpose();
    g += J * q.squaredNorm();
  }
  const Eigen::Vector3f x = H.ldlt().solve(g);
  Eigen::Vector2f c = x.head<2>();
  float r = std::sqrt(std::max(1e-6f, x.z() + c.squaredNorm()));
  for (int step = 0; step < kSteps; ++step) {
    H = Eigen::Matrix3f::Identity() * 1e-3f;
    g.setZero();
    for (const Eigen::Vector2f& p : part.outline) {
      const Eigen::Vector2f q = p - mean - c;
      const float distance = std::max(1e-6f, q.norm());
      if (step > 1 && std::abs(distance - r) > kMaxDistance) continue;
      const Eigen::Vector3f J(-q.x() / distance, -q.y() / distance, -1);
      H += J * J.transpose();
      g += J * (distance - r);
    }
    const Eigen::Vector3f change = H.ldlt().solve(g);
    c -= change.head<2>();
    r -= change.z();
  }
  if (!c.allFinite() || !(r > kMinRadius && r < kMaxRadius)) return std::nullopt;
  return Standing(Shape::kCylinder, heights, mean + c, Eigen::Vector2f::UnitX(),
                  Eigen::Vector2f::Constant(2 * r), X_CT);
}

}  // namespace

const std::vector<Hypothesis>& PartCompletion::SolidsOver(const SurfacePart& part,
                                                          const Eigen::Isometry3d& X_CT) {
  solids_.clear();
  const Range heights = HeightsOf(part, &values_, &side_heights_);
  if (heights.high - heights.low <= 0) return solids_;
  AddBoxesOver(part, heights, X_CT, &values_, &solids_);
  if (const auto cylinder = CylinderOver(part, heights, X_CT)) solids_.push_back(*cylinder);
  return solids_;
}

}  // namespace declutter
