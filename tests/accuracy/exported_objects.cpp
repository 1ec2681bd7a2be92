#include "tests/accuracy/exported_objects.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace declutter::accuracy {
namespace {

using nlohmann::json;

Eigen::Vector3d Vector3(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

Evidence ParseEvidence(const std::string& name) {
  if (name == "observed") return Evidence::kObserved;
  if (name == "free_space") return Evidence::kFreeSpace;
  if (name == "assumed") return Evidence::kAssumed;
  throw std::runtime_error("unknown evidence \"" + name + "\"");
}

ObjectModel ParseModel(const json& j) {
  ObjectModel model;
  model.id = j.at("id").get<int>();
  if (model.id < 1 || model.id > 255) throw std::runtime_error("an object's id outside 1 .. 255");
  const std::string shape = j.at("shape").get<std::string>();
  if (shape != "box" && shape != "cylinder") throw std::runtime_error("unknown shape " + shape);
  model.solid.shape = shape == "box" ? Shape::kBox : Shape::kCylinder;
  const json& q = j.at("orientation");
  model.solid.X_CO.linear() = Eigen::Quaterniond(q.at(0).get<double>(), q.at(1).get<double>(),
                                                 q.at(2).get<double>(), q.at(3).get<double>())
                                  .normalized()
                                  .toRotationMatrix();
  model.solid.X_CO.translation() = Vector3(j.at("position"));
  if (model.solid.shape == Shape::kBox) {
    model.solid.size = Vector3(j.at("size"));
  } else {
    const double diameter = 2 * j.at("radius").get<double>();
    model.solid.size = {diameter, diameter, j.at("height").get<double>()};
  }
  model.confidence = j.at("confidence").get<float>();
  if (j.contains("evidence")) {
    for (size_t i = 0; i < 3; ++i) {
      model.evidence[i] = ParseEvidence(j.at("evidence").at(i).get<std::string>());
    }
  }
  if (j.contains("covariance")) {
    for (int row = 0; row < 7; ++row) {
      for (int column = 0; column < 7; ++column) {
        model.covariance(row, column) = j.at("covariance").at(row).at(column).get<double>();
      }
    }
  }
  return model;
}

ObjectList ParseFrame(const json& j) {
  ObjectList frame;
  frame.header.frame = j.at("frame").get<std::string>();
  frame.header.error = j.value("error", "");
  for (const json& plane : j.value("planes", json::array())) {
    frame.planes.push_back({Vector3(plane.at("normal")), plane.at("d").get<double>()});
  }
  for (const json& object : j.value("objects", json::array())) {
    frame.objects.push_back(ParseModel(object));
  }
  return frame;
}

}  // namespace

std::map<std::string, ObjectList> ReadExportedObjects(const std::filesystem::path& output_dir) {
  const std::filesystem::path path = output_dir / "objects.jsonl";
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be opened");
  std::map<std::string, ObjectList> frames;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string where = path.string() + ":" + std::to_string(number) + ": ";
    try {
      ObjectList frame = ParseFrame(json::parse(line));
      const std::string name = frame.header.frame;
      if (!frames.emplace(name, std::move(frame)).second) {
        throw std::runtime_error("frame " + name + " for the second time");
      }
    } catch (const std::exception& e) {
      throw std::runtime_error(where + e.what());
    }
  }
  return frames;
}

}  // namespace declutter::accuracy
