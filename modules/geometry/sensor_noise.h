#pragma once

namespace declutter {

// [1/m] standard deviation of a measurement along its ray over its squared depth: 0.7 counts of
// disparity of a Kinect, K / z counts with K = 347 m; 2 mm at 1 m.
inline constexpr double kSigmaPerSquaredDepth = 0.002;

// [m] standard deviation of a measurement at depth z along its ray.
template <typename Real>
Real MeasurementSigma(Real z) {
  return static_cast<Real>(kSigmaPerSquaredDepth) * z * z;
}

}  // namespace declutter
