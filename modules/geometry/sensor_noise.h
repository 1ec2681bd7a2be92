#pragma once

namespace declutter {

// [m] standard deviation of a measurement at depth z along its ray: 0.7 counts of disparity of a
// Kinect, K / z counts with K = 347 m; 2 mm at 1 m.
template <typename Real>
Real MeasurementSigma(Real z) {
  return static_cast<Real>(0.002) * z * z;
}

}  // namespace declutter
