#include "tests/golden/stage_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <vector>

#include "modules/geometry/plane.h"

namespace declutter::golden {
namespace {

constexpr double kMillimetres = 1e3;
constexpr double kDegrees = 180.0 / M_PI;

__attribute__((format(printf, 1, 2))) std::string Line(const char* format, ...) {
  char text[400];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return std::string(text) + "\n";
}

const char* NameOf(Shape shape) { return shape == Shape::kBox ? "box" : "cylinder"; }

const char* NameOf(Evidence evidence) {
  static constexpr std::array<const char*, 3> kNames = {"observed", "free_space", "assumed"};
  return kNames[static_cast<size_t>(evidence)];
}

// A box's extents along its longer, its shorter horizontal axis and its height, whichever of the
// first two is called x; a cylinder's diameter twice and its height.
std::array<int, 3> OrderOfAxes(const Solid& solid) {
  const bool is_swapped = solid.shape == Shape::kBox && solid.size.x() < solid.size.y();
  return is_swapped ? std::array<int, 3>{1, 0, 2} : std::array<int, 3>{0, 1, 2};
}

// Of an axis of O about z of T, in [0, 180).
double Heading_deg(const Solid& solid, int axis, const Eigen::Isometry3d& X_TC) {
  const Eigen::Vector3d axis_T = X_TC.linear() * solid.X_CO.linear().col(axis);
  const double angle_deg = std::atan2(axis_T.y(), axis_T.x()) * kDegrees;
  return std::fmod(angle_deg + 360.0, 180.0);
}

double Left_T(const ObjectModel& object, const Eigen::Isometry3d& X_TC) {
  return (X_TC * object.solid.X_CO.translation()).x();
}

std::string Text(const ObjectModel& object, const Eigen::Isometry3d& X_TC,
                 const std::string& support) {
  const Solid& solid = object.solid;
  const auto [a, b, c] = OrderOfAxes(solid);
  const Eigen::Vector3d center = kMillimetres * (X_TC * solid.X_CO.translation());
  const auto sd = [&](int axis) {
    return kMillimetres * std::sqrt(std::max(0.0, object.covariance(3 + axis, 3 + axis)));
  };
  const auto evidence = [&](int axis) {
    return NameOf(object.evidence[static_cast<size_t>(axis)]);
  };
  std::string text = Line("%s center %.1f %.1f %.1f size %.1f %.1f %.1f", NameOf(solid.shape),
                          center.x(), center.y(), center.z(), kMillimetres * solid.size[a],
                          kMillimetres * solid.size[b], kMillimetres * solid.size[c]);
  if (solid.shape == Shape::kBox) text += Line("  heading %.1f", Heading_deg(solid, a, X_TC));
  return text + Line("  evidence %s %s %s", evidence(a), evidence(b), evidence(c)) +
         Line("  sd %.2f %.2f %.2f", sd(a), sd(b), sd(c)) +
         Line("  confidence %.2f votes %d on %s", static_cast<double>(object.confidence),
              object.num_votes, support.c_str()) +
         Line("  explained %d occluded %d violating %d", object.num_explained, object.num_occluded,
              object.num_violating);
}

}  // namespace

std::string Text(const Tabletop& tabletop) {
  std::string text =
      Line("planes %zu object_points %d", tabletop.planes.size(), tabletop.num_object_points);
  for (const SupportPlane& support : tabletop.planes) {
    const Eigen::Vector3d& normal = support.plane.normal;
    text += Line("plane normal %.4f %.4f %.4f height %.1f", normal.x(), normal.y(), normal.z(),
                 kMillimetres * support.plane.d);
  }
  return text;
}

std::string Text(const FeatureCloud& features) {
  constexpr float kRound = 6.0f;  // [1/m] what divides flat from round
  int num_normals = 0, num_round = 0;
  for (const FeaturePoint& point : features.points) {
    num_normals += point.normal.squaredNorm() > 0 ? 1 : 0;
    num_round += std::abs(point.kappa) > kRound ? 1 : 0;
  }
  return Line("points %zu components %d normals %d round %d", features.points.size(),
              features.num_components, num_normals, num_round);
}

std::string Text(const HypothesisList& list) {
  int num_boxes = 0, num_votes = 0;
  for (const Hypothesis& hypothesis : list.hypotheses) {
    num_boxes += hypothesis.solid.shape == Shape::kBox ? 1 : 0;
    num_votes += hypothesis.num_votes;
  }
  return Line("boxes %d cylinders %d all_votes %d", num_boxes,
              static_cast<int>(list.hypotheses.size()) - num_boxes, num_votes);
}

std::string Text(const ObjectList& list) {
  std::string text = Line("objects %zu", list.objects.size());
  if (list.planes.empty()) return text;
  const Eigen::Isometry3d X_TC = TableFrame(list.planes.front());
  std::vector<ObjectModel> objects = list.objects;
  std::sort(objects.begin(), objects.end(), [&](const ObjectModel& a, const ObjectModel& b) {
    return Left_T(a, X_TC) < Left_T(b, X_TC);
  });
  for (const ObjectModel& object : objects) {
    std::string support = "table";
    for (size_t i = 0; i < objects.size(); ++i) {
      if (objects[i].id == object.supported_by) support = "number_" + std::to_string(i + 1);
    }
    text += Text(object, X_TC, support);
  }
  return text;
}

}  // namespace declutter::golden
