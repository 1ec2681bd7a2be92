#include "modules/model_verifier/column.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr double kMinCos = 0.99;  // 8 degrees between sides of one plane

// Of two upright boxes, which horizontal axis of b is along axis i of a.
int AxisAlong(const Eigen::Matrix3d& R_AB, int i) {
  return std::abs(R_AB(i, 0)) > std::abs(R_AB(i, 1)) ? 0 : 1;
}

}  // namespace

bool HaveOneCrossSection(const Solid& a, const Solid& b) {
  const Eigen::Isometry3d X_AB = a.X_CO.inverse() * b.X_CO;
  if (a.shape != b.shape || X_AB.translation().head<2>().norm() >= kEdgeBlur) return false;
  if (a.shape == Shape::kCylinder) return std::abs(a.size.x() - b.size.x()) < kEdgeBlur;
  const int j = AxisAlong(X_AB.linear(), 0);
  return std::abs(X_AB.linear()(0, j)) > kMinCos && std::abs(a.size.x() - b.size[j]) < kEdgeBlur &&
         std::abs(a.size.y() - b.size[1 - j]) < kEdgeBlur;
}

bool AreFlush(const Solid& a, const Solid& b) {
  if (a.shape != Shape::kBox || b.shape != Shape::kBox) return false;
  const Eigen::Isometry3d X_AC = a.X_CO.inverse();
  const Eigen::Isometry3d X_AB = X_AC * b.X_CO;
  for (int i = 0; i < 2; ++i) {
    const double side = std::copysign(1.0, X_AC.translation()[i]);
    if (side * X_AC.translation()[i] < 0.5 * a.size[i]) continue;
    const int j = AxisAlong(X_AB.linear(), i);
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
