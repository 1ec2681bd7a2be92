#include "tests/accuracy/scene_truth.h"

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <stdexcept>

namespace declutter::accuracy {
namespace {

using nlohmann::json;

Eigen::Vector3d Vector3(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

Stance StanceOf(const std::string& pose) {
  if (pose == "standing_on_face" || pose == "axis_vertical" || pose == "standing") {
    return Stance::kStanding;
  }
  if (pose == "axis_horizontal" || pose == "lying") return Stance::kLying;
  if (pose == "tilted") return Stance::kLeaning;
  return Stance::kUnknown;
}

Scope ScopeOf(const std::string& scope) {
  if (scope == "core") return Scope::kCore;
  if (scope == "soft") return Scope::kSoft;
  if (scope == "out") return Scope::kOut;
  throw std::runtime_error("unknown scope \"" + scope + "\"");
}

template <typename Number>
std::optional<Number> NumberAt(const json& j, const char* path) {
  const json::json_pointer pointer(path);
  return j.contains(pointer) ? std::optional(j.at(pointer).get<Number>()) : std::nullopt;
}

std::optional<Eigen::Vector3d> SizeOf(const json& size) {
  if (size.contains("radius")) {
    const double diameter = 2 * size.at("radius").get<double>();
    return Eigen::Vector3d(diameter, diameter, size.at("height").get<double>());
  }
  if (size.contains("size")) return Vector3(size.at("size"));
  if (size.contains("dims") && size.at("dims").size() == 3) return Vector3(size.at("dims"));
  return std::nullopt;
}

// Exact truth, written as the exporter writes a model.
Solid SolidOf(const json& truth, Shape shape) {
  Solid solid;
  solid.shape = shape;
  const json& q = truth.at("orientation");
  const Eigen::Quaterniond rotation(q.at(0).get<double>(), q.at(1).get<double>(),
                                    q.at(2).get<double>(), q.at(3).get<double>());
  solid.X_CO.linear() = rotation.normalized().toRotationMatrix();
  solid.X_CO.translation() = Vector3(truth.at("position"));
  const auto size = SizeOf(truth);
  if (!size) throw std::runtime_error("truth of an object without its size");
  solid.size = *size;
  return solid;
}

std::optional<double> DistanceOf(const json& object) {
  static const char* const kDepths[] = {"/truth/position/2", "/circle_fit/axis_point_cam/2",
                                        "/visible_footprint/visible_centre_cam/2",
                                        "/seed_point_cam/2"};
  for (const char* path : kDepths) {
    if (const auto depth = NumberAt<double>(object, path)) return depth;
  }
  return std::nullopt;
}

void ReadSize(const json& j, TrueObject* object) {
  if (j.contains("truth")) {
    object->solid = SolidOf(j.at("truth"), *object->shape);
    object->size = object->solid->size;
  } else if (j.contains("product_size")) {
    object->size = SizeOf(j.at("product_size"));
    object->size_tolerance_m = NumberAt<double>(j, "/product_size/tol");
  } else if (j.contains("known_size")) {
    object->size = SizeOf(j.at("known_size"));
  }
}

TrueObject ParseObject(const json& j) {
  TrueObject object;
  object.id = j.value("id", 0);
  object.name = j.contains("product") ? j.at("product").get<std::string>() : j.value("name", "");
  object.shape_name = j.at("shape").get<std::string>();
  if (object.shape_name == "box") object.shape = Shape::kBox;
  if (object.shape_name == "cylinder") object.shape = Shape::kCylinder;
  object.stance = StanceOf(j.value("pose", ""));
  object.scope = ScopeOf(j.value("scope", "core"));
  if (j.contains("labels")) object.labels = j.at("labels").get<std::vector<int>>();
  if (j.contains("seed_px")) {
    object.seed_px = {j.at("seed_px").at(0).get<int>(), j.at("seed_px").at(1).get<int>()};
  }
  if (object.shape) ReadSize(j, &object);
  object.distance_m = DistanceOf(j);
  object.num_px = NumberAt<int>(j, "/n_px");
  object.visible_fraction = NumberAt<double>(j, "/truth/visible_fraction");
  return object;
}

// Ids of the objects that a known problem of the scene says not to score.
std::set<int> UnscoredIds(const json& scene) {
  static const std::regex kRemark("object ([0-9]+).*do not score");
  std::set<int> ids;
  for (const json& problem : scene.value("known_problems", json::array())) {
    std::smatch match;
    const std::string text = problem.get<std::string>();
    if (std::regex_search(text, match, kRemark)) ids.insert(std::stoi(match[1]));
  }
  return ids;
}

}  // namespace

SceneTruth ParseSceneTruth(const json& scene) try {
  SceneTruth truth;
  truth.width = scene.at("width").get<int>();
  truth.height = scene.at("height").get<int>();
  if (scene.contains("table_plane")) {
    truth.up_C = Vector3(scene.at("table_plane").at("normal_cam")).normalized();
  }
  const std::set<int> unscored = UnscoredIds(scene);
  int next_id = 1;
  for (const json& j : scene.at("objects")) {
    TrueObject object = ParseObject(j);
    if (object.id == 0) object.id = next_id;
    next_id = object.id + 1;
    if (unscored.count(object.id) > 0) object.scope = Scope::kUnscored;
    truth.objects.push_back(std::move(object));
  }
  return truth;
} catch (const json::exception& e) {
  throw std::runtime_error(e.what());
}

std::string ScopeName(Scope scope) {
  switch (scope) {
    case Scope::kCore:
      return "core";
    case Scope::kSoft:
      return "soft";
    case Scope::kOut:
      return "out";
    case Scope::kUnscored:
      return "unscored";
  }
  return "";
}

std::string ShapeName(Shape shape) { return shape == Shape::kBox ? "box" : "cylinder"; }

}  // namespace declutter::accuracy
