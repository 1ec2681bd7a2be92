#include "modules/scene_renderer/surface_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace declutter {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// [m] spacing of the grain of a table's top.
constexpr double kGrain_m = 0.012;
constexpr double kDaylight = 0.45;
const Vector3d kPaper(0.93, 0.92, 0.88);
const Vector3d kInk(0.12, 0.12, 0.14);
constexpr std::array<uint8_t, 3> kDark = {28, 28, 30};

Vector3d NormalAt(const Solid& solid, int face, const Vector3d& p_O) {
  if (solid.shape == Shape::kCylinder && face == 0) {
    return Vector3d(p_O.x(), p_O.y(), 0).normalized();
  }
  return ((face & 1) ? 1.0 : -1.0) * Vector3d::Unit(face / 2);
}

// Position on the face, each coordinate in [-1, 1], the second one upward.
Vector2d FacePosition(const Solid& solid, int face, const Vector3d& p_O) {
  const Vector3d unit = p_O.cwiseQuotient(0.5 * solid.size);
  if (solid.shape == Shape::kCylinder && face == 0) {
    return {std::remainder(3 * std::atan2(unit.y(), unit.x()) / M_PI, 2.0), unit.z()};
  }
  if (face / 2 == 0) return {unit.y(), unit.z()};
  if (face / 2 == 1) return {unit.x(), unit.z()};
  return {unit.x(), unit.y()};
}

// A picture field, a name in a band and lines of small print; lids are plain with a rim.
Vector3d Print(const Solid& solid, int face, const Vector2d& at, const Vector3d& color) {
  if (solid.shape == Shape::kCylinder && face != 0) {
    return at.norm() > 0.9 ? Vector3d(0.6 * color + 0.2 * kPaper)
                           : Vector3d(0.35 * color + 0.55 * kPaper);
  }
  if (at.y() > 0.35 && at.y() < 0.75 && std::abs(at.x()) < 0.75) {
    const bool letter = std::abs(at.y() - 0.55) < 0.11 && std::abs(at.x()) < 0.6 &&
                        std::sin(31 * at.x() + 2 * std::sin(9 * at.x())) > -0.2;
    return letter ? color * 0.6 : kPaper;
  }
  if ((at - Vector2d(0.1, -0.15)).cwiseQuotient(Vector2d(0.55, 0.33)).norm() < 1) {
    return 0.5 * color + 0.5 * Vector3d(color.y(), color.z(), color.x());
  }
  if (at.y() < -0.6 && std::abs(at.x()) < 0.8 && std::sin(40 * at.y()) > 0.5) return kInk;
  return color;
}

Vector3d Wood(const Vector3d& p_O, const Vector3d& color) {
  const double wave = std::sin(p_O.y() / kGrain_m + 1.5 * std::sin(7 * p_O.x())) +
                      0.5 * std::sin(2.7 * p_O.y() / kGrain_m + 3 * std::sin(4 * p_O.x()));
  return color * (1 + 0.025 * wave);
}

Vector3d ColorAt(const Solid& solid, const Paint& paint, int face, const Vector3d& p_O) {
  switch (paint.material) {
    case Material::kPrinted:
      return Print(solid, face, FacePosition(solid, face, p_O), paint.color);
    case Material::kWood:
      return Wood(p_O, paint.color);
    case Material::kPlain:
      break;
  }
  return paint.color;
}

}  // namespace

ColorImage Photograph(const IdealImage& ideal, const std::vector<Solid>& solids,
                      const std::vector<Paint>& paints, const Vector3d& up_C) {
  ColorImage image{ideal.camera.width, ideal.camera.height, {}};
  image.rgb.reserve(3 * ideal.z.size());
  const Vector3d to_lamp = (up_C + Vector3d(-0.45, 0, -0.35)).normalized();
  std::vector<Eigen::Isometry3d> X_OC;
  for (const Solid& solid : solids) X_OC.push_back(solid.X_CO.inverse());
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const size_t pixel =
          static_cast<size_t>(v) * static_cast<size_t>(image.width) + static_cast<size_t>(u);
      if (ideal.solid[pixel] < 0) {
        image.rgb.insert(image.rgb.end(), kDark.begin(), kDark.end());
        continue;
      }
      const size_t index = static_cast<size_t>(ideal.solid[pixel]);
      const Vector3d p_O =
          X_OC[index] * (ideal.camera.Ray(u, v) * static_cast<double>(ideal.z[pixel]));
      const int face = ideal.face[pixel];
      const Vector3d normal_C = solids[index].X_CO.linear() * NormalAt(solids[index], face, p_O);
      const double light = kDaylight + (1 - kDaylight) * std::max(0.0, normal_C.dot(to_lamp));
      const Vector3d color = light * ColorAt(solids[index], paints[index], face, p_O);
      for (const double c : color) {
        image.rgb.push_back(static_cast<uint8_t>(std::clamp(255 * c, 0.0, 255.0)));
      }
    }
  }
  return image;
}

}  // namespace declutter
