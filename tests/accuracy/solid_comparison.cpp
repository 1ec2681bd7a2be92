#include "tests/accuracy/solid_comparison.h"

#include <algorithm>
#include <cmath>

namespace declutter::accuracy {
namespace {

constexpr int kGrid = 40;  // points along each axis: shares to better than 0.01

double AngleBetweenLines(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::min(1.0, std::abs(a.normalized().dot(b.normalized()))));
}

bool Contains(const Solid& solid, const Eigen::Vector3d& p_O) {
  const Eigen::Vector3d half = 0.5 * solid.size;
  if (std::abs(p_O.z()) > half.z()) return false;
  if (solid.shape == Shape::kCylinder) return p_O.head<2>().norm() <= half.x();
  return std::abs(p_O.x()) <= half.x() && std::abs(p_O.y()) <= half.y();
}

double Volume(const Solid& solid) {
  const double fill = solid.shape == Shape::kCylinder ? M_PI / 4 : 1.0;
  return fill * solid.size.prod();
}

// The axis of the model's box beside each axis of the true one: the pairing of least total angle.
std::array<int, 3> PairAxes(const Eigen::Matrix3d& model, const Eigen::Matrix3d& truth) {
  const Eigen::Matrix3d alignment = (truth.transpose() * model).cwiseAbs();
  std::array<int, 3> order{0, 1, 2};
  std::array<int, 3> best = order;
  double best_sum = -1;
  do {
    const double sum = alignment(0, order[0]) + alignment(1, order[1]) + alignment(2, order[2]);
    if (sum > best_sum + 1e-9) {
      best_sum = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

}  // namespace

double TiltOf(const Solid& solid, const Eigen::Vector3d& up_C) {
  const Eigen::Matrix3d axes = solid.X_CO.linear();
  double tilt = AngleBetweenLines(axes.col(2), up_C);
  if (solid.shape == Shape::kCylinder) return tilt;
  for (int i = 0; i < 2; ++i) tilt = std::min(tilt, AngleBetweenLines(axes.col(i), up_C));
  return tilt;
}

double ShareInside(const Solid& a, const Solid& b) {
  const Eigen::Isometry3d X_BA = b.X_CO.inverse() * a.X_CO;
  int num_points = 0;
  int num_inside = 0;
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      for (int k = 0; k < kGrid; ++k) {
        const Eigen::Vector3d unit((i + 0.5) / kGrid - 0.5, (j + 0.5) / kGrid - 0.5,
                                   (k + 0.5) / kGrid - 0.5);
        const Eigen::Vector3d p_A = unit.cwiseProduct(a.size);
        if (!Contains(a, p_A)) continue;
        ++num_points;
        num_inside += Contains(b, X_BA * p_A) ? 1 : 0;
      }
    }
  }
  return num_points == 0 ? 0.0 : static_cast<double>(num_inside) / num_points;
}

double VolumeIou(const Solid& a, const Solid& b) {
  const double shared = ShareInside(a, b) * Volume(a);
  const double all = Volume(a) + Volume(b) - shared;
  return all > 0 ? shared / all : 0.0;
}

SolidError CompareSolids(const Solid& model, const Solid& truth) {
  SolidError error;
  error.center_C = model.X_CO.translation() - truth.X_CO.translation();
  error.volume_iou = VolumeIou(model, truth);
  const Eigen::Matrix3d model_axes = model.X_CO.linear();
  const Eigen::Matrix3d true_axes = truth.X_CO.linear();
  if (truth.shape == Shape::kCylinder) {
    const double radius = model.radius() - truth.radius();
    error.extent = {radius, radius, model.height() - truth.height()};
    error.axis_rad = AngleBetweenLines(model_axes.col(2), true_axes.col(2));
    return error;
  }
  error.axis = PairAxes(model_axes, true_axes);
  for (int i = 0; i < 3; ++i) {
    error.extent[i] = model.size[error.axis[static_cast<size_t>(i)]] - truth.size[i];
  }
  error.axis_rad = AngleBetweenLines(model_axes.col(error.axis[2]), true_axes.col(2));
  error.yaw_rad = AngleBetweenLines(model_axes.col(error.axis[0]), true_axes.col(0));
  return error;
}

bool IsWithin(const SolidError& error, double tolerance_m) {
  return error.center_C.norm() <= tolerance_m && error.extent.cwiseAbs().maxCoeff() <= tolerance_m;
}

}  // namespace declutter::accuracy
