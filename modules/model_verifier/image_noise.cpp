#include "modules/model_verifier/image_noise.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "modules/geometry/quantile.h"
#include "modules/geometry/sensor_noise.h"

namespace declutter {
namespace {

constexpr int kBlock = 6;               // [px] over which the noise of a sensor is correlated
constexpr int kStep = 2 * kBlock;       // [px] from one block to the next
constexpr float kMaxDeviation = 12;     // [sigma] of pixels on the plane
constexpr size_t kMinBlocks = 50;       // that tell a level to 10 %
constexpr double kUsual = 0.80;         // [sigma] median of the means of blocks: a Kinect's
constexpr double kMin = 0.1, kMax = 5;  // the means of blocks reach kMaxDeviation at most

// Of the pixels of a block from the plane [sigma].
struct Deviations {
  float sum = 0;
  float sum_of_squares = 0;
  float sum_of_squared_steps = 0;  // from each pixel to the one on its right

  static constexpr float kNum = kBlock * kBlock;
  static constexpr float kNumSteps = kBlock * (kBlock - 1);

  float Mean() const { return sum / kNum; }
  float Variance() const { return (sum_of_squares - sum * Mean()) / (kNum - 1); }
  // Half the variance of a step over that of a pixel.
  float Independence() const { return sum_of_squared_steps / (2 * kNumSteps) / Variance(); }
};

// Nothing unless all of a block was measured on the plane.
std::optional<Deviations> DeviationsOf(const PixelGrid& grid, const Plane& plane, int u_begin,
                                       int v_begin) {
  const Eigen::Vector3f n = plane.normal.cast<float>();
  const auto d = static_cast<float>(plane.d);
  Deviations deviations;
  for (int v = v_begin; v < v_begin + kBlock; ++v) {
    const float row = n.y() * grid.ray_y[static_cast<size_t>(v)] + n.z();
    const float* const z = &grid.z[static_cast<size_t>(v) * grid.stride];
    float before = 0;
    for (int u = u_begin; u < u_begin + kBlock; ++u) {
      // Along the ray: 1 / z of the plane is linear in the image.
      const float inverse = -(n.x() * grid.ray_x[static_cast<size_t>(u)] + row) / d;
      const float deviation =
          (z[u] * inverse - 1) * inverse / static_cast<float>(kSigmaPerSquaredDepth);
      if (!(z[u] > 0 && inverse > 0 && std::abs(deviation) < kMaxDeviation)) return std::nullopt;
      deviations.sum += deviation;
      deviations.sum_of_squares += deviation * deviation;
      const float step = u > u_begin ? deviation - before : 0;
      deviations.sum_of_squared_steps += step * step;
      before = deviation;
    }
  }
  return deviations;
}

}  // namespace

ImageNoise ImageNoiseMeter::Measure(const PixelGrid& every_pixel, const Plane& support) {
  means_.clear();
  independences_.clear();
  for (int v = 0; v + kBlock <= every_pixel.rows; v += kStep) {
    for (int u = 0; u + kBlock <= every_pixel.columns; u += kStep) {
      const auto deviations = DeviationsOf(every_pixel, support, u, v);
      if (!deviations) continue;
      means_.push_back(std::abs(deviations->Mean()));
      if (deviations->Variance() > 0) independences_.push_back(deviations->Independence());
    }
  }
  ImageNoise noise;
  // What lies flat on the plane must not count.
  if (means_.size() >= kMinBlocks) {
    noise.level = std::clamp(static_cast<double>(Quantile(&means_, 0.5f)) / kUsual, kMin, kMax);
  }
  if (independences_.size() >= kMinBlocks) {
    noise.independence = std::min(1.0, static_cast<double>(Quantile(&independences_, 0.5f)));
  }
  return noise;
}

}  // namespace declutter
