#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace declutter {

// Intrinsics of a rectified pinhole camera. Camera frame C: x right, y down, z forward.
struct PinholeCamera {
  int width = 0;   // [px]
  int height = 0;  // [px]
  double fx = 0;   // [px]
  double fy = 0;   // [px]
  double cx = 0;   // [px]
  double cy = 0;   // [px]

  int num_pixels() const { return width * height; }

  // Point of C with z = 1 that pixel (u, v) sees.
  Eigen::Vector3d Ray(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }

  // Pixel coordinates of p_C; z of p_C must be positive.
  Eigen::Vector2d Project(const Eigen::Vector3d& p_C) const {
    return {fx * p_C.x() / p_C.z() + cx, fy * p_C.y() / p_C.z() + cy};
  }
};

// One depth measurement per pixel, as the sensor counts it.
struct DepthImage {
  PinholeCamera camera;
  double depth_scale_m = 0.001;  // [m] per count
  std::vector<uint16_t> counts;  // row-major, camera.num_pixels() long; 0 is no measurement

  bool empty() const { return counts.empty(); }
  uint16_t CountAt(int u, int v) const {
    return counts[static_cast<size_t>(v) * static_cast<size_t>(camera.width) +
                  static_cast<size_t>(u)];
  }
  // [m] z of pixel (u, v) in C; 0 is no measurement.
  double DepthAt(int u, int v) const { return CountAt(u, v) * depth_scale_m; }
  // Position of pixel (u, v) in C; only where there is a measurement.
  Eigen::Vector3d PointAt(int u, int v) const { return camera.Ray(u, v) * DepthAt(u, v); }
};

// What names a frame on its way through the graph.
struct FrameHeader {
  int64_t utime = 0;  // [us] time of the sensor
  std::string frame;  // name of the scene or stream
  std::string error;  // why the source has no image for this frame; empty when it has one
};

// What is left of a larger image when only the pixels with u % step = v % step = 0 are kept: pixel
// (u, v) is pixel (step u, step v) of the sensor's image.
struct Decimation {
  int step = 1;
  int sensor_width = 0;   // [px]
  int sensor_height = 0;  // [px]

  // The camera of the sensor's image, from that of the kept one.
  PinholeCamera SensorCamera(const PinholeCamera& kept) const {
    return {sensor_width,   sensor_height,  step * kept.fx,
            step * kept.fy, step * kept.cx, step * kept.cy};
  }
};

// A depth image with its time and the pose X_WC of the camera in the world.
struct DepthFrame {
  FrameHeader header;
  DepthImage image;  // empty when header.error is set
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  std::optional<Decimation> decimation = std::nullopt;  // of image; none: it is the sensor's
};

// A colour image registered to the depth image of the same frame, 8-bit RGB interleaved.
struct ColorImage {
  int width = 0;             // [px]
  int height = 0;            // [px]
  std::vector<uint8_t> rgb;  // row-major, 3 * width * height long
};

}  // namespace declutter
