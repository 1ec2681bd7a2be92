#include "modules/object_exporter/overlay.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "modules/imaging/canvas.h"
#include "modules/object_exporter/object_tags.h"
#include "modules/object_exporter/wireframe.h"

namespace declutter {
namespace {

using imaging::Canvas;
using imaging::Rgb;

constexpr Rgb kBlack = {0, 0, 0};
constexpr double kTintOpacity = 0.35;
// Something measured so far before an outline hides it; less is the noise of the sensor.
constexpr double kMinGapM = 0.02;

template <typename Image>
bool HasSizeOf(const PinholeCamera& camera, const Image* image) {
  return image != nullptr && image->width == camera.width && image->height == camera.height;
}

ColorImage GreyOf(const DepthImage& depth) {
  std::vector<uint16_t> measured;
  std::copy_if(depth.counts.begin(), depth.counts.end(), std::back_inserter(measured),
               [](uint16_t count) { return count > 0; });
  ColorImage image{depth.camera.width, depth.camera.height, {}};
  image.rgb.resize(3 * depth.counts.size());
  if (measured.empty()) return image;
  std::sort(measured.begin(), measured.end());
  const double near = measured[measured.size() / 50];
  const double far =
      std::max<double>(measured[measured.size() - 1 - measured.size() / 50], near + 1);
  for (size_t i = 0; i < depth.counts.size(); ++i) {
    if (depth.counts[i] == 0) continue;
    const double share = std::clamp((far - depth.counts[i]) / (far - near), 0.0, 1.0);
    std::fill_n(&image.rgb[3 * i], 3, static_cast<uint8_t>(40 + 190 * share));
  }
  return image;
}

ColorImage Background(const PinholeCamera& camera, const DepthImage* depth,
                      const ColorImage* color) {
  if (HasSizeOf(camera, color)) return *color;
  if (depth != nullptr && HasSizeOf(depth->camera, &camera) && !depth->empty()) {
    return GreyOf(*depth);
  }
  const auto num_values = 3 * static_cast<size_t>(camera.num_pixels());
  return {camera.width, camera.height, std::vector<uint8_t>(num_values)};
}

// Tints the pixels of every object and rims them.
void DrawLabels(const ObjectList& list, Canvas* canvas) {
  const auto label_at = [&](int u, int v) {
    return list.labels[static_cast<size_t>(v) * static_cast<size_t>(list.camera.width) +
                       static_cast<size_t>(u)];
  };
  for (int v = 0; v < list.camera.height; ++v) {
    for (int u = 0; u < list.camera.width; ++u) {
      const int id = label_at(u, v);
      if (id == 0) continue;
      const bool is_rim = u == 0 || v == 0 || u + 1 == list.camera.width ||
                          v + 1 == list.camera.height || label_at(u - 1, v) != id ||
                          label_at(u + 1, v) != id || label_at(u, v - 1) != id ||
                          label_at(u, v + 1) != id;
      canvas->Blend(u, v, ColorOf(id), is_rim ? 2 * kTintOpacity : kTintOpacity);
    }
  }
}

bool IsHidden(const Eigen::Vector3d& p_C, const PinholeCamera& camera, const DepthImage* depth) {
  if (depth == nullptr) return false;
  const Eigen::Vector2d pixel = camera.Project(p_C).array().round();
  const bool is_inside =
      pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < camera.width && pixel.y() < camera.height;
  if (!is_inside) return false;
  const double measured_m =
      depth->DepthAt(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  return measured_m > 0 && measured_m < p_C.z() - kMinGapM;
}

// Hidden pieces first, so that no bright line is crossed by a thin one.
void DrawOutline(const Solid& solid, const Rgb& color, const PinholeCamera& camera,
                 const DepthImage* depth, int scale, Canvas* canvas) {
  std::vector<WireSegment> seen;
  for (const WireSegment& piece : Wireframe(solid)) {
    if (piece.from_C.z() < kMinDrawnDepthM || piece.to_C.z() < kMinDrawnDepthM) continue;
    if (piece.faces_camera && !IsHidden((piece.from_C + piece.to_C) / 2, camera, depth)) {
      seen.push_back(piece);
    } else {
      canvas->DrawLine(camera.Project(piece.from_C), camera.Project(piece.to_C), 0.5 * scale, color,
                       0.55);
    }
  }
  for (const WireSegment& piece : seen) {
    canvas->DrawLine(camera.Project(piece.from_C), camera.Project(piece.to_C), 1.9 * scale, kBlack,
                     0.5);
  }
  for (const WireSegment& piece : seen) {
    canvas->DrawLine(camera.Project(piece.from_C), camera.Project(piece.to_C), scale, color);
  }
}

}  // namespace

ColorImage DrawOverlay(const ObjectList& list, const DepthImage* depth, const ColorImage* color) {
  const PinholeCamera& camera = list.camera;
  if (depth != nullptr && (!HasSizeOf(depth->camera, &camera) || depth->empty())) depth = nullptr;
  Canvas canvas(Background(camera, depth, color));
  const int scale = std::max(1, camera.width / 320);
  DrawLabels(list, &canvas);
  for (const ObjectModel& object : list.objects) {
    DrawOutline(object.solid, ColorOf(object.id), camera, depth, scale, &canvas);
  }
  DrawTags(list, scale, &canvas);
  return canvas.image();
}

}  // namespace declutter
