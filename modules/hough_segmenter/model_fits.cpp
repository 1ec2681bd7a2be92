#include "modules/hough_segmenter/model_fits.h"

#include <Eigen/Dense>
#include <cmath>

namespace declutter {
namespace {

using Field = CellArrays::Field;

template <typename Model>
void SetHeights(const CellArrays& inliers, Model* model) {
  const Range heights = RangeOf(inliers.field(Field::kZ), inliers.size());
  model->z_min = heights.low;
  model->z_max = heights.high;
}

}  // namespace

void FitToInliers(const CellArrays& inliers, LineModel* line) {
  const float* x = inliers.field(Field::kX);
  const float* y = inliers.field(Field::kY);
  const PointSums sums =
      SumPoints(x, y, inliers.field(Field::kFitWeight), inliers.size(), x[0], y[0]);
  const Eigen::Vector2d mean(double{sums.x} / sums.w, double{sums.y} / sums.w);
  const double xx = sums.xx - mean.x() * sums.x;
  const double xy = sums.xy - mean.x() * sums.y;
  const double yy = sums.yy - mean.y() * sums.y;
  // Direction of the larger axis of the scatter; the normal is across it.
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  Eigen::Vector2f n(static_cast<float>(-std::sin(angle)), static_cast<float>(std::cos(angle)));
  if (n.dot(line->n) < 0) n = -n;
  line->n = n;
  line->rho = n.dot(Eigen::Vector2f(x[0], y[0]) + mean.cast<float>());
}

void FitToInliers(const CellArrays& inliers, CircleModel* circle) {
  constexpr int kMaxSteps = 4;
  constexpr double kMinStep = 1e-6;  // [m]
  Eigen::Vector3d x(circle->c.x(), circle->c.y(), circle->r);
  for (int k = 0; k < kMaxSteps; ++k) {
    const Eigen::Vector3f at = x.cast<float>();
    const CircleSums sums =
        SumCircle(inliers.field(Field::kX), inliers.field(Field::kY),
                  inliers.field(Field::kFitWeight), inliers.size(), {at.x(), at.y(), at.z()});
    Eigen::Matrix3d H;
    H << sums.xx, sums.xy, sums.x, sums.xy, sums.yy, sums.y, sums.x, sums.y, sums.w;
    H.diagonal().array() += 1e-9;
    const Eigen::Vector3d step = H.ldlt().solve(Eigen::Vector3d(sums.xe, sums.ye, sums.e));
    x = at.cast<double>() + step;
    if (!(step.cwiseAbs().maxCoeff() > kMinStep)) break;
  }
  if (!x.allFinite() || x.z() <= 0) return;
  circle->c = x.head<2>().cast<float>();
  circle->r = static_cast<float>(x.z());
}

void SetExtent(const CellArrays& inliers, LineModel* line) {
  const Eigen::Vector2f t = line->tangent();
  const Range range =
      RangeAlong(inliers.field(Field::kX), inliers.field(Field::kY), inliers.size(), t.x(), t.y());
  line->s_min = range.low;
  line->s_max = range.high;
  SetHeights(inliers, line);
}

void SetExtent(const CellArrays& inliers, CircleModel* circle) { SetHeights(inliers, circle); }

}  // namespace declutter
