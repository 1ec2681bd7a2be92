#include "modules/frame_views/point_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "modules/object_exporter/object_tags.h"

namespace declutter {
namespace {

using Eigen::Vector3d;

constexpr double kMaxPointsOfSolid = 1e6;
constexpr uint32_t kWhite = 0xFFFFFF;

uint32_t Packed(uint8_t red, uint8_t green, uint8_t blue) {
  return uint32_t{red} << 16 | uint32_t{green} << 8 | blue;
}

template <typename Image>
bool HasSizeOf(const PinholeCamera& camera, const Image& image) {
  return image.width == camera.width && image.height == camera.height;
}

// Puts the points of one solid into a cloud.
class SurfaceSampler {
 public:
  SurfaceSampler(const ObjectModel& object, double spacing_m, PointCloud* cloud)
      : solid_(object.solid), cloud_(cloud) {
    const Vector3d& size = solid_.size;
    const double area_m2 = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
    spacing_m_ = std::max(spacing_m, std::sqrt(area_m2 / kMaxPointsOfSolid));
    const auto [red, green, blue] = ColorOf(object.id);
    rgb_ = Packed(red, green, blue);
    label_ = static_cast<uint32_t>(object.id);
  }

  void Sample() { solid_.shape == Shape::kBox ? SampleBox() : SampleCylinder(); }

 private:
  int NumSteps(double length_m) const {
    return std::max(1, static_cast<int>(std::ceil(length_m / spacing_m_)));
  }

  void Add(const Vector3d& p_O) {
    cloud_->points.push_back({(solid_.X_CO * p_O).cast<float>(), rgb_, label_});
  }

  void SampleBox() {
    for (int axis = 0; axis < 3; ++axis) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      const int num_a = NumSteps(solid_.size[a]), num_b = NumSteps(solid_.size[b]);
      for (int i = 0; i <= num_a; ++i) {
        for (int j = 0; j <= num_b; ++j) {
          Vector3d p_O = Vector3d::Zero();
          p_O[axis] = solid_.size[axis] / 2;
          p_O[a] = solid_.size[a] * (1.0 * i / num_a - 0.5);
          p_O[b] = solid_.size[b] * (1.0 * j / num_b - 0.5);
          Add(p_O);
          p_O[axis] = -p_O[axis];
          Add(p_O);
        }
      }
    }
  }

  void SampleCircle(double radius_m, double z_m) {
    const int num = NumSteps(2 * M_PI * radius_m);
    for (int i = 0; i < num; ++i) {
      const double angle_rad = 2 * M_PI * i / num;
      Add({radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), z_m});
    }
  }

  void SampleCylinder() {
    const int num_rings = NumSteps(solid_.height());
    for (int i = 0; i <= num_rings; ++i) {
      SampleCircle(solid_.radius(), solid_.height() * (1.0 * i / num_rings - 0.5));
    }
    const int num_circles = NumSteps(solid_.radius());
    for (int i = 0; i < num_circles; ++i) {
      for (const double side : {-0.5, 0.5}) {
        SampleCircle(solid_.radius() * i / num_circles, side * solid_.height());
      }
    }
  }

  const Solid& solid_;
  PointCloud* cloud_;
  double spacing_m_ = 0.0;
  uint32_t rgb_ = 0;
  uint32_t label_ = 0;
};

template <typename Value>
void AppendLittleEndian(const Value& value, std::string* bytes) {
  std::array<char, sizeof(Value)> raw;
  std::memcpy(raw.data(), &value, sizeof value);
  bytes->append(raw.data(), raw.size());
}

}  // namespace

PointCloud MeasuredCloud(const DepthImage& depth, const ColorImage* color,
                         const ObjectList* objects) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const PinholeCamera& camera = depth.camera;
  if (color != nullptr && !HasSizeOf(camera, *color)) color = nullptr;
  if (objects != nullptr && !HasSizeOf(camera, objects->camera)) objects = nullptr;
  PointCloud cloud{camera.width, camera.height, {}};
  cloud.points.reserve(depth.counts.size());
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const size_t i = cloud.points.size();
      CloudPoint point{{kNan, kNan, kNan}, kWhite, 0};
      if (depth.CountAt(u, v) > 0) point.p_C = depth.PointAt(u, v).cast<float>();
      if (color != nullptr) {
        point.rgb = Packed(color->rgb[3 * i], color->rgb[3 * i + 1], color->rgb[3 * i + 2]);
      }
      if (objects != nullptr) point.label = objects->labels[i];
      cloud.points.push_back(point);
    }
  }
  return cloud;
}

PointCloud ModelCloud(const ObjectList& objects, double spacing_m) {
  PointCloud cloud;
  for (const ObjectModel& object : objects.objects) {
    SurfaceSampler(object, spacing_m, &cloud).Sample();
  }
  cloud.width = static_cast<int>(cloud.points.size());
  cloud.height = 1;
  return cloud;
}

std::string PcdFile(const PointCloud& cloud) {
  const std::string num = std::to_string(cloud.points.size());
  std::string file =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb label\n"
      "SIZE 4 4 4 4 4\nTYPE F F F F U\nCOUNT 1 1 1 1 1\nWIDTH " +
      std::to_string(cloud.width) + "\nHEIGHT " + std::to_string(cloud.height) +
      "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + num + "\nDATA binary\n";
  for (const CloudPoint& point : cloud.points) {
    for (const float coordinate_m : point.p_C) AppendLittleEndian(coordinate_m, &file);
    AppendLittleEndian(point.rgb, &file);
    AppendLittleEndian(point.label, &file);
  }
  return file;
}

}  // namespace declutter
