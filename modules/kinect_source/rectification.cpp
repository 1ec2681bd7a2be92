#include "modules/kinect_source/rectification.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

// Where the lens puts the ray (x, y, 1).
Eigen::Vector2d Distort(const Distortion& d, double x, double y) {
  const auto& [k1, k2, p1, p2, k3] = d;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

}  // namespace

Rectification::Rectification(const PinholeCamera& camera, const Distortion& distortion) {
  source_.reserve(static_cast<size_t>(camera.num_pixels()));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.Ray(u, v);
      const Eigen::Vector2d seen = Distort(distortion, ray.x(), ray.y());
      const double column = std::round(camera.fx * seen.x() + camera.cx);
      const double row = std::round(camera.fy * seen.y() + camera.cy);
      const bool is_inside =
          column >= 0 && column < camera.width && row >= 0 && row < camera.height;
      source_.push_back(is_inside ? static_cast<int>(row) * camera.width + static_cast<int>(column)
                                  : -1);
    }
  }
}

std::shared_ptr<const Rectification> RectificationOf(const CameraFile& file) {
  const Distortion& d = file.distortion;
  if (std::all_of(d.begin(), d.end(), [](double k) { return k == 0; })) return nullptr;
  return std::make_shared<const Rectification>(file.camera, d);
}

void Rectification::Apply(DepthImage* image) const {
  std::vector<uint16_t> counts(source_.size(), 0);
  for (size_t i = 0; i < source_.size(); ++i) {
    if (source_[i] >= 0) counts[i] = image->counts[static_cast<size_t>(source_[i])];
  }
  image->counts = std::move(counts);
}

void Rectification::Apply(ColorImage* image) const {
  std::vector<uint8_t> rgb(3 * source_.size(), 0);
  for (size_t i = 0; i < source_.size(); ++i) {
    if (source_[i] < 0) continue;
    std::copy_n(image->rgb.begin() + 3 * source_[i], 3,
                rgb.begin() + 3 * static_cast<std::ptrdiff_t>(i));
  }
  image->rgb = std::move(rgb);
}

}  // namespace declutter
