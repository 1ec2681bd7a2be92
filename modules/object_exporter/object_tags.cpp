#include "modules/object_exporter/object_tags.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "modules/object_exporter/wireframe.h"

namespace declutter {
namespace {

using Eigen::Vector2d;
using imaging::Canvas;
using imaging::Rgb;

constexpr std::array<Rgb, 12> kPalette = {{{255, 70, 60},
                                           {60, 170, 255},
                                           {90, 230, 60},
                                           {255, 200, 0},
                                           {225, 80, 255},
                                           {0, 230, 210},
                                           {255, 140, 30},
                                           {140, 120, 255},
                                           {190, 255, 100},
                                           {255, 110, 170},
                                           {120, 220, 255},
                                           {215, 170, 110}}};
constexpr Rgb kBlack = {0, 0, 0};
constexpr Rgb kWhite = {255, 255, 255};
// [px] A tag is moved by one pixel rather than hide so many pixels of objects.
constexpr int kHiddenPerStep = 12;
constexpr int kStep = 3;  // [px] between the places that are tried

struct Rectangle {
  int u, v, width, height;

  bool Overlaps(const Rectangle& other) const {
    return u < other.u + other.width && other.u < u + width && v < other.v + other.height &&
           other.v < v + height;
  }
};

struct Tag {
  std::string title;
  std::string details;
  Vector2d anchor;  // [px] the middle of the object
  Rectangle place;
};

std::string Format(const char* format, double a, double b, double c, double d) {
  char text[96];
  std::snprintf(text, sizeof text, format, a, b, c, d);
  return text;
}

int NumLabelled(const ObjectList& list, const Rectangle& place) {
  int num = 0;
  for (int v = place.v; v < place.v + place.height; ++v) {
    const auto row = list.labels.begin() + static_cast<std::ptrdiff_t>(v) * list.camera.width;
    num +=
        place.width - static_cast<int>(std::count(row + place.u, row + place.u + place.width, 0));
  }
  return num;
}

// [px] Where the tag would hide nothing of its own object: v of the highest point of the outline.
double TopOf(const Solid& solid, const PinholeCamera& camera) {
  double top = camera.height;
  for (const WireSegment& piece : Wireframe(solid)) {
    if (piece.from_C.z() > kMinDrawnDepthM) top = std::min(top, camera.Project(piece.from_C).y());
  }
  return top;
}

// The cheapest place above or below the one just over the object; the first one when the image has
// no free place.
Rectangle PlaceTag(const ObjectList& list, const Rectangle& first, const std::vector<Tag>& tags) {
  Rectangle best = first;
  int min_cost = std::numeric_limits<int>::max();
  for (int v = 0; v + first.height <= list.camera.height; v += kStep) {
    const Rectangle place = {first.u, v, first.width, first.height};
    const int way_cost = kHiddenPerStep * std::abs(v - first.v);
    if (way_cost >= min_cost) continue;
    const bool is_free = std::none_of(
        tags.begin(), tags.end(), [&](const Tag& other) { return place.Overlaps(other.place); });
    if (!is_free) continue;
    const int cost = way_cost + NumLabelled(list, place);
    if (cost >= min_cost) continue;
    min_cost = cost;
    best = place;
  }
  return best;
}

Tag TagOf(const ObjectList& list, const ObjectModel& object, int scale,
          const std::vector<Tag>& tags) {
  const Eigen::Vector3d size_mm = 1000 * object.solid.size;
  const double confidence = static_cast<double>(object.confidence);
  const bool is_box = object.solid.shape == Shape::kBox;
  Tag tag;
  tag.title = std::to_string(object.id) + (is_box ? " box" : " cylinder");
  tag.details =
      is_box ? Format("%.0fx%.0fx%.0f mm %.2f", size_mm.x(), size_mm.y(), size_mm.z(), confidence)
             : Format("r %.0f h %.0f mm %.2f", size_mm.x() / 2, size_mm.z(), confidence, 0);
  const int small = std::max(1, scale / 2);
  const int text_width =
      std::max(Canvas::TextWidth(tag.title, scale), Canvas::TextWidth(tag.details, small));
  const PinholeCamera& camera = list.camera;
  Rectangle first = {
      0, 0, std::min(text_width + 5 * scale, camera.width),
      std::min(Canvas::TextHeight(scale) + Canvas::TextHeight(small) + 3 * scale, camera.height)};
  const Eigen::Vector3d& center_C = object.solid.X_CO.translation();
  tag.anchor = center_C.z() > kMinDrawnDepthM ? camera.Project(center_C)
                                              : Vector2d(camera.width / 2.0, camera.height);
  first.u = static_cast<int>(
      std::clamp<double>(tag.anchor.x() - first.width / 2.0, 0, camera.width - first.width));
  first.v = static_cast<int>(std::clamp<double>(TopOf(object.solid, camera) - first.height - 2, 0,
                                                camera.height - first.height));
  tag.place = PlaceTag(list, first, tags);
  return tag;
}

void DrawTag(const Tag& tag, const Rgb& color, int scale, Canvas* canvas) {
  const Rectangle& place = tag.place;
  canvas->FillRectangle(place.u, place.v, place.width, place.height, kBlack, 0.7);
  canvas->FillRectangle(place.u, place.v, 2 * scale, place.height, color);
  const int text_u = place.u + 3 * scale;
  canvas->DrawText(text_u, place.v + scale, tag.title, scale, kWhite);
  canvas->DrawText(text_u, place.v + Canvas::TextHeight(scale) + 2 * scale, tag.details,
                   std::max(1, scale / 2), kWhite);
}

}  // namespace

Rgb ColorOf(int id) { return kPalette[static_cast<size_t>(id - 1) % kPalette.size()]; }

void DrawTags(const ObjectList& list, int scale, Canvas* canvas) {
  std::vector<Tag> tags;
  for (const ObjectModel& object : list.objects) {
    tags.push_back(TagOf(list, object, scale, tags));
    const Rectangle& place = tags.back().place;
    const Vector2d edge(place.u + place.width / 2.0,
                        tags.back().anchor.y() > place.v ? place.v + place.height : place.v);
    canvas->DrawLine(edge, tags.back().anchor, 0.5 * scale, ColorOf(object.id));
  }
  for (size_t i = 0; i < tags.size(); ++i) {
    DrawTag(tags[i], ColorOf(list.objects[i].id), scale, canvas);
  }
}

}  // namespace declutter
