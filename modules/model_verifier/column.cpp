#include "modules/model_verifier/column.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {

bool HaveOneCrossSection(const Solid& a, const Solid& b) {
  const auto range = [](const Solid& solid) { return std::minmax(solid.size.x(), solid.size.y()); };
  const Eigen::Vector3d shift_O =
      a.X_CO.linear().transpose() * (b.X_CO.translation() - a.X_CO.translation());
  return a.shape == b.shape && shift_O.head<2>().norm() < kEdgeBlur &&
         std::abs(range(a).first - range(b).first) < kEdgeBlur &&
         std::abs(range(a).second - range(b).second) < kEdgeBlur;
}

bool AreFlush(const Solid& a, const Solid& b) {
  constexpr double kMinCos = 0.99;  // 8 degrees between sides of one plane
  if (a.shape != Shape::kBox || b.shape != Shape::kBox) return false;
  const Eigen::Isometry3d X_AC = a.X_CO.inverse();
  const Eigen::Isometry3d X_AB = X_AC * b.X_CO;
  for (int i = 0; i < 2; ++i) {
    const double side = std::copysign(1.0, X_AC.translation()[i]);
    if (side * X_AC.translation()[i] < 0.5 * a.size[i]) continue;
    const int j = std::abs(X_AB.linear()(i, 0)) > std::abs(X_AB.linear()(i, 1)) ? 0 : 1;
    const double offset = side * X_AB.translation()[i] + 0.5 * (b.size[j] - a.size[i]);
    if (std::abs(X_AB.linear()(i, j)) < kMinCos || std::abs(offset) > kEdgeBlur) return false;
  }
  return true;
}

bool IsTopSeen(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O, int pixel_weight) {
  const Eigen::Vector3d half = 0.5 * solid.size;
  const auto num = std::count_if(points_O.begin(), points_O.end(), [&](const Eigen::Vector3d& p) {
    const double inside = solid.shape == Shape::kBox ? (half - p.cwiseAbs()).head<2>().minCoeff()
                                                     : half.x() - p.head<2>().norm();
    return inside > kEdgeBlur && p.z() > half.z() - kEdgeBlur;
  });
  return pixel_weight * num >= kMinFitPoints;
}

}  // namespace declutter
