#include <cmath>

#include "modules/hough_segmenter/quantile.h"
#include "modules/hough_segmenter/solid_completion.h"

namespace declutter {
namespace {

constexpr float kMaxDistance = 0.005f;  // [m] of a point from the side
constexpr float kMinCos = 0.7f;         // normals bend near outlines
constexpr size_t kMinPoints = 25;       // [px] that show a side

bool IsTopOnly(const Hypothesis& hypothesis) {
  return hypothesis.solid.X_CO.linear().col(2).z() > 0.99 &&
         hypothesis.solid.height() < 1.01 * static_cast<double>(kTopOnlyDepth);
}

// A standing solid seen from above, in its frame O.
class Footprint {
 public:
  explicit Footprint(const Solid& solid)
      : is_round_(solid.shape == Shape::kCylinder),
        half_(0.5f * solid.size.head<2>().cast<float>()),
        centre_(solid.X_CO.translation().head<2>().cast<float>()),
        x_axis_(solid.X_CO.linear().col(0).head<2>().cast<float>()) {}

  // [m] around all points on the side, of which none has a larger sigma.
  Eigen::AlignedBox2f Box(float max_sigma) const {
    const Eigen::Vector2f x = x_axis_.cwiseAbs();
    const Eigen::Vector2f half =
        Eigen::Vector2f::Constant(Tolerance(max_sigma)) +
        (is_round_ ? half_ : Eigen::Vector2f(half_.x() * x + half_.y() * x.reverse()));
    return {centre_ - half, centre_ + half};
  }

  // True for a point on the side whose normal, as far as it is horizontal, is that of the side.
  bool IsOnSide(const SurfacePoint& point) const {
    const float tolerance = Tolerance(point.sigma);
    const Eigen::Vector2f p = ToO(point.p_T.head<2>() - centre_);
    const auto looks_along = [&](const Eigen::Vector2f& outward) {
      const Eigen::Vector2f n = ToO(point.n_T.head<2>());
      return n.dot(outward) > kMinCos * n.norm() * outward.norm();
    };
    if (is_round_) return std::abs(p.norm() - half_.x()) < tolerance && looks_along(p);
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(std::abs(p[axis]) - half_[axis]) < tolerance &&
          std::abs(p[1 - axis]) < half_[1 - axis] &&
          looks_along(std::copysign(1.0f, p[axis]) * Eigen::Vector2f::Unit(axis))) {
        return true;
      }
    }
    return false;
  }

  // False for a square of the grid, given by its middle in T, that lies well inside or outside.
  bool MayHaveSide(const Eigen::Vector2f& middle, float max_sigma) const {
    const Eigen::Vector2f p = ToO(middle - centre_);
    const float reach = Tolerance(max_sigma) + PointGrid::kHalfDiagonal;
    // Beyond the side [m], along both axes or the radius.
    const Eigen::Vector2f beyond = is_round_ ? Eigen::Vector2f::Constant(p.norm() - half_.x())
                                             : Eigen::Vector2f(p.cwiseAbs() - half_);
    return beyond.maxCoeff() > -reach && beyond.maxCoeff() < reach;
  }

 private:
  static float Tolerance(float sigma) { return std::max(kMaxDistance, 2.5f * sigma); }

  Eigen::Vector2f ToO(const Eigen::Vector2f& x_T) const {
    return {x_axis_.dot(x_T), x_axis_.x() * x_T.y() - x_axis_.y() * x_T.x()};
  }

  bool is_round_;
  Eigen::Vector2f half_;
  Eigen::Vector2f centre_;
  Eigen::Vector2f x_axis_;
};

}  // namespace

void SolidCompletion::AddSidesBelowTops(const PointGrid& sides,
                                        std::vector<Hypothesis>* hypotheses) {
  const size_t num = hypotheses->size();
  std::vector<float>& heights = z_values_;
  for (size_t i = 0; i < num; ++i) {
    if (!IsTopOnly((*hypotheses)[i])) continue;
    Hypothesis taller = (*hypotheses)[i];
    const auto top =
        static_cast<float>(taller.solid.X_CO.translation().z() + 0.5 * taller.solid.height());
    const Footprint footprint(taller.solid);
    heights.clear();
    sides.ForEachIn(
        footprint.Box(sides.max_sigma()),
        [&](const Eigen::Vector2f& middle) {
          return footprint.MayHaveSide(middle, sides.max_sigma());
        },
        [&](const SurfacePoint& point) {
          if (point.p_T.z() < top && footprint.IsOnSide(point)) heights.push_back(point.p_T.z());
        });
    if (heights.size() < kMinPoints) continue;
    taller.num_inliers += static_cast<int>(heights.size());
    const float bottom = BottomOf(Quantile(&heights, 0.02));
    taller.solid.X_CO.translation().z() = 0.5 * static_cast<double>(top + bottom);
    taller.solid.size.z() = static_cast<double>(top - bottom);
    taller.evidence[2] = bottom > 0 ? Evidence::kAssumed : Evidence::kObserved;
    hypotheses->push_back(taller);
  }
}

}  // namespace declutter
