#include "tests/accuracy/scored_frame.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "modules/imaging/png_file.h"
#include "modules/scene_renderer/scene_text.h"
#include "tests/accuracy/exported_objects.h"
#include "tests/accuracy/pixel_overlap.h"
#include "tests/accuracy/radius_bound.h"

namespace declutter::accuracy {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> FindScenes(const fs::path& scene_dir) {
  if (fs::exists(scene_dir / "scene.json")) return {scene_dir};
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(scene_dir)) {
    if (entry.path().filename() == "scene.json") scenes.push_back(entry.path().parent_path());
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

// Name of a folder, also when the path ends in / or is relative.
std::string FolderName(const fs::path& path) {
  const fs::path whole = fs::absolute(path).lexically_normal();
  return whole.has_filename() ? whole.filename().string() : whole.parent_path().filename().string();
}

std::string FrameName(const fs::path& scene_dir, const fs::path& scene) {
  if (scene == scene_dir) return FolderName(scene);
  std::string name = scene.lexically_relative(scene_dir).generic_string();
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

// The first folder below scene_dir, or scene_dir's name for scenes that lie in it directly.
std::string GroupName(const fs::path& scene_dir, const fs::path& scene) {
  const fs::path below = scene.lexically_relative(scene_dir);
  return std::distance(below.begin(), below.end()) > 1 ? below.begin()->string()
                                                       : FolderName(scene_dir);
}

nlohmann::json ReadJson(const fs::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

// Adds what limits the accuracy of estimates to the truth of a rendered scene.
void AddBounds(const fs::path& scene, const nlohmann::json& json, SceneTruth* truth) {
  const auto& objects = truth->objects;
  const bool has_cylinder = std::any_of(objects.begin(), objects.end(), [](const TrueObject& o) {
    return o.shape == Shape::kCylinder && o.solid;
  });
  if (!has_cylinder || truth->labels.empty()) return;
  const SceneNoise noise = ReadScene((scene / "scene.textproto").string()).noise();
  const auto depth = imaging::ReadGray16Png((scene / "depth.png").string());
  const PinholeCamera camera = {depth.width,
                                depth.height,
                                json.at("fx").get<double>(),
                                json.at("fy").get<double>(),
                                json.at("cx").get<double>(),
                                json.at("cy").get<double>()};
  if (truth->labels.size() != depth.pixels.size()) return;
  std::vector<std::vector<int>> pixels = PixelsOfObjects(*truth);
  for (size_t i = 0; i < pixels.size(); ++i) {
    TrueObject& object = truth->objects[i];
    if (object.shape != Shape::kCylinder || !object.solid) continue;
    const auto is_unmeasured = [&](int pixel) {
      return depth.pixels[static_cast<size_t>(pixel)] == 0;
    };
    pixels[i].erase(std::remove_if(pixels[i].begin(), pixels[i].end(), is_unmeasured),
                    pixels[i].end());
    object.radius_bound_m = RadiusBound(*object.solid, camera, pixels[i], noise);
  }
}

SceneTruth ReadTruth(const fs::path& scene_dir, const fs::path& scene, const nlohmann::json& json) {
  SceneTruth truth = ParseSceneTruth(json);
  truth.frame = FrameName(scene_dir, scene);
  truth.group = GroupName(scene_dir, scene);
  if (fs::exists(scene / "labels.png")) {
    truth.labels = imaging::ReadGray8Png((scene / "labels.png").string()).pixels;
  }
  if (fs::exists(scene / "scene.textproto")) AddBounds(scene, json, &truth);
  return truth;
}

void ReadLabels(const fs::path& output_dir, ObjectList* found) {
  const fs::path path = output_dir / (found->header.frame + ".labels.png");
  imaging::GrayImage<uint8_t> image = imaging::ReadGray8Png(path.string());
  found->camera.width = image.width;
  found->camera.height = image.height;
  found->labels = std::move(image.pixels);
}

}  // namespace

std::vector<ScoredFrame> ScoreFolder(const fs::path& scene_dir, const fs::path& output_dir) {
  std::map<std::string, ObjectList> exported = ReadExportedObjects(output_dir);
  std::vector<ScoredFrame> frames;
  for (const fs::path& scene : FindScenes(scene_dir)) {
    try {
      const nlohmann::json json = ReadJson(scene / "scene.json");
      if (!json.contains("objects")) continue;
      ScoredFrame frame;
      frame.truth = ReadTruth(scene_dir, scene, json);
      const auto found = exported.find(frame.truth.frame);
      frame.has_result = found != exported.end();
      if (frame.has_result) frame.found = std::move(found->second);
      if (!frame.found.objects.empty()) ReadLabels(output_dir, &frame.found);
      frame.score = MatchObjects(frame.truth, frame.found);
      frame.truth.labels = {};
      frame.found.labels = {};
      frames.push_back(std::move(frame));
    } catch (const std::exception& e) {
      throw std::runtime_error(scene.string() + ": " + e.what());
    }
  }
  return frames;
}

}  // namespace declutter::accuracy
