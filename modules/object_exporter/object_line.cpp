#include "modules/object_exporter/object_line.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace declutter {
namespace {

using nlohmann::ordered_json;

// A micrometre: far below what is measured, and short to write. Zero has no sign.
double Rounded(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }

ordered_json Vector(const Eigen::Vector3d& v) {
  return {Rounded(v.x()), Rounded(v.y()), Rounded(v.z())};
}

ordered_json Quaternion(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() *= -1;
  return {Rounded(q.w()), Rounded(q.x()), Rounded(q.y()), Rounded(q.z())};
}

const char* NameOf(Evidence evidence) {
  switch (evidence) {
    case Evidence::kObserved:
      return "observed";
    case Evidence::kFreeSpace:
      return "free_space";
    default:
      return "assumed";
  }
}

ordered_json Planes(const ObjectList& list) {
  ordered_json planes = ordered_json::array();
  for (const Plane& plane : list.planes) {
    planes.push_back({{"normal", Vector(plane.normal)}, {"d", Rounded(plane.d)}});
  }
  return planes;
}

// Rows. Variances of fractions of a millimetre need more decimals than lengths.
ordered_json Matrix(const SolidCovariance& covariance) {
  constexpr double kPerUnit = 1e10;
  ordered_json rows = ordered_json::array();
  for (const auto& row : covariance.rowwise()) {
    ordered_json values = ordered_json::array();
    for (const double value : row) values.push_back(std::round(value * kPerUnit) / kPerUnit);
    rows.push_back(std::move(values));
  }
  return rows;
}

// Pixels of each label.
using LabelCounts = std::array<int64_t, 256>;

LabelCounts CountLabels(const std::vector<uint8_t>& labels) {
  LabelCounts counts = {};
  for (const uint8_t label : labels) ++counts[label];
  return counts;
}

ordered_json Object(const ObjectModel& model, const LabelCounts& num_labelled) {
  const Solid& solid = model.solid;
  const bool is_box = solid.shape == Shape::kBox;
  ordered_json object;
  object["id"] = model.id;
  object["shape"] = is_box ? "box" : "cylinder";
  object["position"] = Vector(solid.X_CO.translation());
  object["orientation"] = Quaternion(solid.X_CO.linear());
  if (is_box) {
    object["size"] = Vector(solid.size);
  } else {
    object["radius"] = Rounded(solid.radius());
    object["height"] = Rounded(solid.height());
  }
  object["confidence"] = Rounded(static_cast<double>(model.confidence));
  object["evidence"] = {NameOf(model.evidence[0]), NameOf(model.evidence[1]),
                        NameOf(model.evidence[2])};
  object["covariance"] = Matrix(model.covariance);
  object["supported_by"] = model.supported_by;
  object["votes"] = model.num_votes;
  object["visible_px"] = num_labelled[static_cast<uint8_t>(model.id)];
  object["explained_px"] = model.num_explained;
  object["occluded_px"] = model.num_occluded;
  object["violating_px"] = model.num_violating;
  return object;
}

}  // namespace

std::string ObjectLine(const ObjectList& list, const std::string& picture_name) {
  ordered_json line;
  line["frame"] = list.header.frame;
  line["utime"] = list.header.utime;
  if (!list.header.error.empty()) line["error"] = list.header.error;
  line["planes"] = Planes(list);
  line["objects"] = ordered_json::array();
  const LabelCounts num_labelled = CountLabels(list.labels);
  for (const ObjectModel& model : list.objects) {
    line["objects"].push_back(Object(model, num_labelled));
  }
  if (!picture_name.empty()) {
    line["labels"] = picture_name + ".labels.png";
    line["overlay"] = picture_name + ".overlay.png";
  }
  // A name that is not UTF-8 must not cost the line.
  return line.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace declutter
