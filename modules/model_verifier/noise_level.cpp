#include "modules/model_verifier/noise_level.h"

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

// [sigma] mean deviation of a block from the plane; nothing unless all of it was measured on it.
std::optional<float> MeanDeviation(const PixelGrid& grid, const Plane& plane, int u_begin,
                                   int v_begin) {
  const Eigen::Vector3f n = plane.normal.cast<float>();
  const auto d = static_cast<float>(plane.d);
  float sum = 0;
  for (int v = v_begin; v < v_begin + kBlock; ++v) {
    const float row = n.y() * grid.ray_y[static_cast<size_t>(v)] + n.z();
    const float* const z = &grid.z[static_cast<size_t>(v) * grid.stride];
    for (int u = u_begin; u < u_begin + kBlock; ++u) {
      // Along the ray: 1 / z of the plane is linear in the image.
      const float inverse = -(n.x() * grid.ray_x[static_cast<size_t>(u)] + row) / d;
      const float deviation =
          (z[u] * inverse - 1) * inverse / static_cast<float>(kSigmaPerSquaredDepth);
      if (!(z[u] > 0 && inverse > 0 && std::abs(deviation) < kMaxDeviation)) return std::nullopt;
      sum += deviation;
    }
  }
  return sum / (kBlock * kBlock);
}

}  // namespace

double NoiseLevel(const Observation& every_pixel, std::vector<float>* deviations) {
  const PixelGrid& grid = every_pixel.grid;
  deviations->clear();
  for (int v = 0; v + kBlock <= grid.rows; v += kStep) {
    for (int u = 0; u + kBlock <= grid.columns; u += kStep) {
      const auto mean = MeanDeviation(grid, every_pixel.support, u, v);
      if (mean) deviations->push_back(std::abs(*mean));
    }
  }
  if (deviations->size() < kMinBlocks) return 1;
  // What lies flat on the plane must not count.
  return std::clamp(static_cast<double>(Quantile(deviations, 0.5f)) / kUsual, kMin, kMax);
}

}  // namespace declutter
