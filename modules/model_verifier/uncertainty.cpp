#include "modules/model_verifier/uncertainty.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "modules/geometry/sensor_noise.h"

namespace declutter {
namespace {

constexpr double kPixelsPerSample = 36;  // over which the noise of a sensor is correlated
constexpr double kFaceBias = 0.5;        // [sigma] of a face, however many points it has
constexpr double kEdgeError = 0.5;       // [px] of an edge
constexpr double kSupportSd = 0.0007;    // [m] of the support plane at an object
constexpr double kAssumedSd = 0.025;     // [m] of an end that nothing bounds
constexpr double kDepthBias = 0.5;       // [sigma] of all depths around an object
constexpr double kSideSd = 0.0003;       // [m] of a cylinder's side, however little noise there is
constexpr double kMaxSd = 0.1;           // [m]

double Square(double x) { return x * x; }

// [m] along an axis of O at its end that one pixel covers.
double PixelLength(const Solid& solid, int axis, int sign, const PinholeCamera& camera) {
  constexpr double kStep = 0.001;  // [m]
  Eigen::Vector3d p_O = Eigen::Vector3d(0, 0, 0.5 * solid.size.z());
  p_O[axis] = 0.5 * sign * solid.size[axis];
  const Eigen::Vector3d p_C = solid.X_CO * p_O;
  const Eigen::Vector3d q_C = p_C + kStep * solid.X_CO.linear().col(axis);
  if (p_C.z() <= 0.05 || q_C.z() <= 0.05) return kMaxSd;
  return kStep / std::max(0.01, (camera.Project(q_C) - camera.Project(p_C)).norm());
}

// [m^2] of the place of one end.
double VarianceOfEnd(const Solid& solid, EndEvidence end, int axis, int sign, double sigma,
                     int num_points, const PinholeCamera& camera) {
  switch (end) {
    case EndEvidence::kFace:
      return Square(sigma) * (kPixelsPerSample / std::max(1, num_points) + Square(kFaceBias));
    case EndEvidence::kEdge:
      return Square(kEdgeError * PixelLength(solid, axis, sign, camera)) +
             Square(kFaceBias * sigma);
    case EndEvidence::kSupport:
      return Square(kSupportSd);
    case EndEvidence::kFreeSpace:
      return Square(kFreeSpaceReach) / 12;  // anywhere in it
    case EndEvidence::kAssumed:
      return Square(kAssumedSd);
  }
  return Square(kMaxSd);
}

// Adds an end of an axis: centre and extent are (low + high) / 2 and high - low.
void AddEnds(int axis, const std::array<double, 2>& variances, SolidCovariance* covariance) {
  const auto [variance_low, variance_high] = variances;
  (*covariance)(axis, axis) += 0.25 * (variance_low + variance_high);
  (*covariance)(3 + axis, 3 + axis) += variance_low + variance_high;
  (*covariance)(axis, 3 + axis) += 0.5 * (variance_high - variance_low);
  (*covariance)(3 + axis, axis) += 0.5 * (variance_high - variance_low);
}

// Of centre along x and y of O and radius, from the points on the side.
Eigen::Matrix3d CovarianceOfSide(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O,
                                 int pixel_weight, double sigma) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity() / Square(kMaxSd);
  for (const Eigen::Vector3d& p_O : points_O) {
    const double distance = p_O.head<2>().norm();
    if (distance - solid.radius() < std::abs(p_O.z()) - 0.5 * solid.height()) continue;
    const Eigen::Vector3d J(-p_O.x() / distance, -p_O.y() / distance, -1);
    H += pixel_weight / (kPixelsPerSample * Square(sigma)) * J * J.transpose();
  }
  return H.inverse() + (Square(kFaceBias * sigma) + Square(kSideSd)) * Eigen::Matrix3d::Identity();
}

// [rad^2] of the rotation about z of a box: the error of a face along its length.
double VarianceOfYaw(const Solid& solid, const SolidEnds& ends, double sigma,
                     const PinholeCamera& camera) {
  double smallest = Square(0.5);
  for (int axis = 0; axis < 2; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const EndEvidence end = ends[static_cast<size_t>(axis)][static_cast<size_t>(side)];
      if (end != EndEvidence::kFace && end != EndEvidence::kEdge) continue;
      const double length = solid.size[1 - axis];
      const double variance =
          VarianceOfEnd(solid, end, axis, side == 0 ? -1 : 1, sigma, 200, camera);
      smallest = std::min(smallest, 6 * variance / Square(length));
    }
  }
  return smallest;
}

// Adds the error that all depths around an object have in common.
void AddDepth(const Solid& solid, double sigma, SolidCovariance* covariance) {
  const Eigen::Vector3d ray_O =
      (solid.X_CO.linear().transpose() * solid.X_CO.translation()).normalized();
  covariance->topLeftCorner<3, 3>() += Square(kDepthBias * sigma) * ray_O * ray_O.transpose();
}

// [m] of a measurement on a solid, along its ray.
double SigmaAt(const Solid& solid, double noise_level) {
  return noise_level * MeasurementSigma(solid.X_CO.translation().z());
}

}  // namespace

EndVariances VariancesOf(const Solid& solid, const SolidEnds& ends, int num_explained,
                         const PinholeCamera& camera, double noise_level) {
  const double sigma = SigmaAt(solid, noise_level);
  EndVariances variances;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (size_t side = 0; side < 2; ++side) {
      variances[axis][side] = VarianceOfEnd(solid, ends[axis][side], static_cast<int>(axis),
                                            side == 0 ? -1 : 1, sigma, num_explained / 3, camera);
    }
  }
  return variances;
}

SolidCovariance CovarianceOfBox(const Solid& seen, const SolidEnds& ends,
                                const EndVariances& variances, const PinholeCamera& camera,
                                double noise_level) {
  const double sigma = SigmaAt(seen, noise_level);
  SolidCovariance covariance = SolidCovariance::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    AddEnds(axis, variances[static_cast<size_t>(axis)], &covariance);
  }
  covariance(6, 6) = VarianceOfYaw(seen, ends, sigma, camera);
  AddDepth(seen, sigma, &covariance);
  return covariance;
}

SolidCovariance CovarianceOfCylinder(const Solid& cylinder, const EndVariances& variances,
                                     const std::vector<Eigen::Vector3d>& points_O, int pixel_weight,
                                     double noise_level) {
  const double sigma = SigmaAt(cylinder, noise_level);
  SolidCovariance covariance = SolidCovariance::Zero();
  AddEnds(2, variances[2], &covariance);
  // Diameters are twice the radius.
  Eigen::Matrix<double, 4, 3> J = Eigen::Matrix<double, 4, 3>::Zero();
  J(0, 0) = J(1, 1) = 1;
  J(2, 2) = J(3, 2) = 2;
  const Eigen::Matrix4d side =
      J * CovarianceOfSide(cylinder, points_O, pixel_weight, sigma) * J.transpose();
  const int indices[4] = {0, 1, 3, 4};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) covariance(indices[i], indices[j]) += side(i, j);
  }
  AddDepth(cylinder, sigma, &covariance);
  return covariance;
}

}  // namespace declutter
