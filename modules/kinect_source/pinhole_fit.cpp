#include "modules/kinect_source/pinhole_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace declutter {
namespace {

constexpr double kMaxResidualPx = 0.5;
constexpr int kMinPoints = 100;
constexpr double kFineScaleM = 1e-4;
constexpr double kCoarseScaleM = 1e-3;
constexpr double kMaxCount = std::numeric_limits<uint16_t>::max();

bool IsMeasured(const Eigen::Vector3f& point) { return point.allFinite() && point.z() > 0; }

// Least squares line pixel = focal * slope + center.
class LineFit {
 public:
  void Add(double slope, double pixel) {
    ++num_;
    const double slope_step = slope - mean_slope_;
    const double pixel_step = pixel - mean_pixel_;
    mean_slope_ += slope_step / num_;
    mean_pixel_ += pixel_step / num_;
    slope_slope_ += slope_step * (slope - mean_slope_);
    slope_pixel_ += slope_step * (pixel - mean_pixel_);
    pixel_pixel_ += pixel_step * (pixel - mean_pixel_);
  }
  int num() const { return num_; }
  // Without a spread of a few pixels the focal length is anything.
  bool IsDetermined() const { return num_ >= kMinPoints && pixel_pixel_ > 4.0 * num_; }
  double focal() const { return slope_pixel_ / slope_slope_; }
  double center() const { return mean_pixel_ - focal() * mean_slope_; }
  double rms() const {
    return std::sqrt(std::max(0.0, pixel_pixel_ - focal() * slope_pixel_) / num_);
  }

 private:
  int num_ = 0;
  double mean_slope_ = 0;
  double mean_pixel_ = 0;
  double slope_slope_ = 0;
  double slope_pixel_ = 0;
  double pixel_pixel_ = 0;
};

double ScaleFor(const std::vector<Eigen::Vector3f>& points, const std::vector<int>& pixels) {
  bool is_whole_mm = true;
  for (size_t i = 0; i < points.size(); ++i) {
    if (pixels[i] < 0) continue;
    const double z = points[i].z();
    if (z > kMaxCount * kFineScaleM) return kCoarseScaleM;
    const double count = z / kCoarseScaleM;
    is_whole_mm = is_whole_mm && std::abs(count - std::round(count)) < 0.02;
  }
  return is_whole_mm ? kCoarseScaleM : kFineScaleM;
}

}  // namespace

PinholeCamera FitPinholeCamera(int width, int height, const std::vector<Eigen::Vector3f>& points) {
  LineFit u_fit;
  LineFit v_fit;
  for (int v = 0, i = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u, ++i) {
      const Eigen::Vector3d point = points[static_cast<size_t>(i)].cast<double>();
      if (!IsMeasured(points[static_cast<size_t>(i)])) continue;
      u_fit.Add(point.x() / point.z(), u);
      v_fit.Add(point.y() / point.z(), v);
    }
  }
  if (!u_fit.IsDetermined() || !v_fit.IsDetermined()) {
    throw std::runtime_error("only " + std::to_string(u_fit.num()) +
                             " measured points, too few or too close to find the camera from");
  }
  const double residual_px = std::hypot(u_fit.rms(), v_fit.rms());
  if (!(residual_px <= kMaxResidualPx) || u_fit.focal() <= 0 || v_fit.focal() <= 0) {
    throw std::runtime_error(
        "the grid of points is not the image of a pinhole camera with x right, y down, z forward "
        "(best fit is off by " +
        std::to_string(residual_px) + " px rms)");
  }
  return {width, height, u_fit.focal(), v_fit.focal(), u_fit.center(), v_fit.center()};
}

std::vector<int> GridPixels(const std::vector<Eigen::Vector3f>& points) {
  std::vector<int> pixels(points.size(), -1);
  for (size_t i = 0; i < points.size(); ++i) {
    if (IsMeasured(points[i])) pixels[i] = static_cast<int>(i);
  }
  return pixels;
}

std::vector<int> ProjectedPixels(const PinholeCamera& camera,
                                 const std::vector<Eigen::Vector3f>& points) {
  std::vector<int> pixels(points.size(), -1);
  std::vector<int> nearest(static_cast<size_t>(camera.num_pixels()), -1);  // point of each pixel
  for (size_t i = 0; i < points.size(); ++i) {
    if (!IsMeasured(points[i])) continue;
    const Eigen::Vector2d pixel = camera.Project(points[i].cast<double>()).array().round();
    if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= camera.width || pixel.y() >= camera.height) {
      continue;
    }
    const int index = static_cast<int>(pixel.y()) * camera.width + static_cast<int>(pixel.x());
    int& owner = nearest[static_cast<size_t>(index)];
    if (owner >= 0 && points[static_cast<size_t>(owner)].z() <= points[i].z()) continue;
    if (owner >= 0) pixels[static_cast<size_t>(owner)] = -1;
    owner = static_cast<int>(i);
    pixels[i] = index;
  }
  return pixels;
}

DepthImage DepthOf(const PinholeCamera& camera, const std::vector<Eigen::Vector3f>& points,
                   const std::vector<int>& pixels) {
  DepthImage image{camera, ScaleFor(points, pixels),
                   std::vector<uint16_t>(static_cast<size_t>(camera.num_pixels()))};
  for (size_t i = 0; i < points.size(); ++i) {
    if (pixels[i] < 0) continue;
    const double count = std::round(points[i].z() / image.depth_scale_m);
    if (!(count >= 1 && count <= kMaxCount)) continue;
    image.counts[static_cast<size_t>(pixels[i])] = static_cast<uint16_t>(count);
  }
  return image;
}

}  // namespace declutter
