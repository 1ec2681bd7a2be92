#include "modules/frame_views/top_view.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/geometry/convex_hull.h"
#include "modules/imaging/canvas.h"
#include "modules/object_exporter/object_tags.h"

namespace declutter {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using imaging::Canvas;
using imaging::Rgb;

constexpr double kPixelsPerMetre = 1500.0;
constexpr int kMaxSide_px = 1000;
constexpr double kMargin_m = 0.1;
constexpr double kFarOff_m = 3.0;  // what is farther from the camera's foot is not shown
constexpr double kSamePlace_m = 0.04;
constexpr Rgb kBackground = {18, 18, 22};
constexpr Rgb kHull = {110, 110, 120};
constexpr Rgb kPoint = {150, 150, 160};
constexpr Rgb kBoxHypothesis = {255, 225, 90};
constexpr Rgb kCylinderHypothesis = {90, 225, 255};
constexpr Rgb kText = {235, 235, 235};

using Polygon = std::vector<Vector2d>;

// Outline of a solid seen along z of T, which may lie on its side.
Polygon Footprint(const Solid& solid, const Eigen::Isometry3d& X_TC) {
  constexpr int kCorners = 48;
  const Vector3d half = solid.size / 2;
  const int num_corners = solid.shape == Shape::kBox ? 4 : kCorners;
  Polygon corners;
  for (int i = 0; i < num_corners; ++i) {
    const double angle_rad = 2 * M_PI * (i + 0.5) / num_corners;
    const double reach = solid.shape == Shape::kBox ? std::sqrt(2.0) : 1.0;  // (1, 1) of a box
    const Vector2d direction = reach * Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    for (const int side : {-1, 1}) {
      const Vector3d p_O(half.x() * direction.x(), half.y() * direction.y(), side * half.z());
      corners.push_back((X_TC * (solid.X_CO * p_O)).head<2>());
    }
  }
  return ConvexHull(std::move(corners));
}

// Where things are on the table, and how they come on the picture.
class Map {
 public:
  void Cover(const Vector2d& p_T) {
    if (p_T.norm() < kFarOff_m) bounds_.extend(p_T);
  }

  bool is_empty() const { return bounds_.isEmpty(); }

  Canvas MakeCanvas() {
    if (is_empty()) bounds_.extend(Vector2d::Zero());
    const Vector2d extent = bounds_.sizes() + Vector2d::Constant(2 * kMargin_m);
    scale_ = std::min(kPixelsPerMetre, kMaxSide_px / extent.maxCoeff());
    const auto width = static_cast<int>(std::ceil(scale_ * extent.x()));
    const auto height = static_cast<int>(std::ceil(scale_ * extent.y()));
    const size_t num_values = 3 * static_cast<size_t>(width) * static_cast<size_t>(height);
    Canvas canvas({width, height, std::vector<uint8_t>(num_values)});
    canvas.FillRectangle(0, 0, width, height, kBackground);
    return canvas;
  }

  Vector2d PixelOf(const Vector2d& p_T) const {
    return {scale_ * (p_T.x() - bounds_.min().x() + kMargin_m),
            scale_ * (bounds_.max().y() + kMargin_m - p_T.y())};
  }

  double scale() const { return scale_; }  // [px/m]

 private:
  Eigen::AlignedBox2d bounds_;
  double scale_ = kPixelsPerMetre;
};

void DrawPolygon(const Polygon& polygon, const Map& map, double thickness_px, const Rgb& color,
                 double opacity, Canvas* canvas) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    canvas->DrawLine(map.PixelOf(polygon[i]), map.PixelOf(polygon[(i + 1) % polygon.size()]),
                     thickness_px, color, opacity);
  }
}

void DrawTextAt(const Vector2d& p_T, const Map& map, const std::string& text, const Rgb& color,
                Canvas* canvas) {
  constexpr int kScale = 2;
  const Vector2d pixel = map.PixelOf(p_T);
  if (!(pixel.cwiseAbs().maxCoeff() < 2 * kMaxSide_px)) return;
  canvas->DrawText(static_cast<int>(pixel.x()) - Canvas::TextWidth(text, kScale) / 2,
                   static_cast<int>(pixel.y()) - Canvas::TextHeight(kScale) / 2, text, kScale,
                   color);
}

// The points of the objects and the hulls of the planes, in T.
struct Measured {
  std::vector<Vector2d> points;
  std::vector<Polygon> hulls;
};

Measured Measure(const Tabletop& tabletop, const Eigen::Isometry3d& X_TC) {
  Measured measured;
  const PinholeCamera& camera = tabletop.objects.camera;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (tabletop.objects.CountAt(u, v) == 0) continue;
      measured.points.push_back((X_TC * tabletop.objects.PointAt(u, v)).head<2>());
    }
  }
  for (const SupportPlane& support : tabletop.planes) {
    Polygon hull;
    for (const Eigen::Vector3f& p_C : support.hull) {
      hull.push_back((X_TC * p_C.cast<double>()).head<2>());
    }
    measured.hulls.push_back(std::move(hull));
  }
  return measured;
}

void DrawMeasured(const Measured& measured, const Map& map, Canvas* canvas) {
  for (const Vector2d& p_T : measured.points) {
    const Vector2d pixel = map.PixelOf(p_T);
    if (p_T.norm() > kFarOff_m) continue;
    canvas->Blend(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()), kPoint, 0.5);
  }
  for (const Polygon& hull : measured.hulls) DrawPolygon(hull, map, 1.5, kHull, 1.0, canvas);
}

void DrawHypotheses(const HypothesisList& list, const Eigen::Isometry3d& X_TC, const Map& map,
                    Canvas* canvas) {
  std::vector<const Hypothesis*> by_votes;
  for (const Hypothesis& hypothesis : list.hypotheses) by_votes.push_back(&hypothesis);
  std::stable_sort(by_votes.begin(), by_votes.end(), [](const Hypothesis* a, const Hypothesis* b) {
    return a->num_votes > b->num_votes;
  });
  std::vector<Vector2d> labelled;
  for (const Hypothesis* hypothesis : by_votes) {
    const Rgb& color =
        hypothesis->solid.shape == Shape::kBox ? kBoxHypothesis : kCylinderHypothesis;
    const double share = hypothesis->num_votes / std::max(1.0, 1.0 * by_votes[0]->num_votes);
    DrawPolygon(Footprint(hypothesis->solid, X_TC), map, 1.2, color, 0.25 + 0.65 * share, canvas);
    const Vector2d center = (X_TC * hypothesis->solid.X_CO.translation()).head<2>();
    const bool is_free = std::none_of(labelled.begin(), labelled.end(), [&](const Vector2d& other) {
      return (other - center).norm() < kSamePlace_m;
    });
    if (!is_free || hypothesis->num_votes == 0) continue;
    labelled.push_back(center);
    const Vector2d below(0.0, -12.0 / map.scale());  // the id of an object is at its centre
    DrawTextAt(center + below, map, std::to_string(hypothesis->num_votes), color, canvas);
  }
}

void DrawObjects(const ObjectList& list, const Eigen::Isometry3d& X_TC, const Map& map,
                 Canvas* canvas) {
  for (const ObjectModel& object : list.objects) {
    DrawPolygon(Footprint(object.solid, X_TC), map, 3.0, ColorOf(object.id), 1.0, canvas);
  }
  for (const ObjectModel& object : list.objects) {
    const Vector2d above(0.0, 8.0 / map.scale());
    DrawTextAt((X_TC * object.solid.X_CO.translation()).head<2>() + above, map,
               std::to_string(object.id), ColorOf(object.id), canvas);
  }
}

// A bar of 100 mm in the lower left corner.
void DrawScale(const Map& map, Canvas* canvas) {
  constexpr int kInset_px = 10;
  const int v = canvas->image().height - kInset_px;
  canvas->FillRectangle(kInset_px, v, static_cast<int>(0.1 * map.scale()), 3, kText);
  canvas->DrawText(kInset_px, v - 20, "100 MM", 2, kText);
}

std::optional<Plane> MainSupport(const TopViewParts& parts) {
  if (parts.tabletop != nullptr && !parts.tabletop->planes.empty()) {
    return parts.tabletop->planes.front().plane;
  }
  if (parts.objects != nullptr && !parts.objects->planes.empty()) {
    return parts.objects->planes.front();
  }
  if (parts.hypotheses != nullptr && !parts.hypotheses->planes.empty()) {
    return parts.hypotheses->planes.front();
  }
  return std::nullopt;
}

}  // namespace

ColorImage DrawTopView(const TopViewParts& parts) {
  const auto support = MainSupport(parts);
  if (!support) return {};
  const Eigen::Isometry3d X_TC = TableFrame(*support);
  const Measured measured = parts.tabletop != nullptr ? Measure(*parts.tabletop, X_TC) : Measured{};
  // What matters is shown as large as possible: single points are measured anywhere.
  Map map;
  if (parts.objects != nullptr) {
    for (const ObjectModel& object : parts.objects->objects) {
      for (const Vector2d& p_T : Footprint(object.solid, X_TC)) map.Cover(p_T);
    }
  }
  if (map.is_empty()) {
    for (const Vector2d& p_T : measured.points) map.Cover(p_T);
  }
  if (map.is_empty()) {
    for (const Polygon& hull : measured.hulls) {
      for (const Vector2d& p_T : hull) map.Cover(p_T);
    }
  }
  Canvas canvas = map.MakeCanvas();
  DrawMeasured(measured, map, &canvas);
  if (parts.hypotheses != nullptr) DrawHypotheses(*parts.hypotheses, X_TC, map, &canvas);
  if (parts.objects != nullptr) DrawObjects(*parts.objects, X_TC, map, &canvas);
  DrawScale(map, &canvas);
  return canvas.image();
}

}  // namespace declutter
