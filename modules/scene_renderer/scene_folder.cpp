#include "modules/scene_renderer/scene_folder.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "modules/imaging/png_file.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMinCore_px = 300;

Json ToJson(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json KnownSize(const Solid& solid) {
  if (solid.shape == Shape::kCylinder) {
    return {{"radius", solid.radius()}, {"height", solid.height()}};
  }
  std::array<double, 3> sides = {solid.size.x(), solid.size.y(), solid.size.z()};
  std::sort(sides.begin(), sides.end(), std::greater<>());
  return {{"dims", sides}};
}

Json RestsOn(const TrueObject& object) {
  return object.rests_on == 0 ? Json("table") : Json(object.rests_on);
}

Json Truth(const TrueObject& object) {
  const Eigen::Quaterniond q(object.solid.X_CO.linear());
  Json truth = {{"position", ToJson(object.solid.X_CO.translation())},
                {"orientation", {q.w(), q.x(), q.y(), q.z()}}};
  if (object.solid.shape == Shape::kBox) {
    truth["size"] = ToJson(object.solid.size);
  } else {
    truth["radius"] = object.solid.radius();
    truth["height"] = object.solid.height();
  }
  truth["visible_fraction"] = object.visible_fraction();
  truth["rests_on"] = RestsOn(object);
  return truth;
}

Json Describe(const TrueObject& object) {
  const bool box = object.solid.shape == Shape::kBox;
  return {{"id", object.id},
          {"labels", {object.label}},
          {"shape", box ? "box" : "cylinder"},
          {"pose", box ? "standing_on_face" : "axis_vertical"},
          {"scope", object.num_px >= kMinCore_px ? "core" : "soft"},
          {"rests_on", object.rests_on == 0 ? "table" : "stacked"},
          {"n_px", object.num_px},
          {"seed_px", object.seed_px},
          {"known_size", KnownSize(object.solid)},
          {"truth", Truth(object)}};
}

void WriteText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace

nlohmann::ordered_json DescribeScene(const RenderedScene& rendered, const std::string& id) {
  const PinholeCamera& camera = rendered.depth.camera;
  const auto& counts = rendered.depth.counts;
  const auto num_missing = std::count(counts.begin(), counts.end(), uint16_t{0});
  Json scene = {{"id", id},
                {"sensor", "rendered, noise: " + rendered.scene.noise().model()},
                {"width", camera.width},
                {"height", camera.height},
                {"fx", camera.fx},
                {"fy", camera.fy},
                {"cx", camera.cx},
                {"cy", camera.cy},
                {"depth_scale_m", rendered.depth.depth_scale_m},
                {"valid_px", camera.num_pixels() - num_missing},
                {"table_plane",
                 {{"normal_cam", ToJson(rendered.table.normal)},
                  {"d", rendered.table.d},
                  {"note", "n.x+d=0, height above table = n.x+d, camera at +d"}}},
                {"label_scheme",
                 "0 none, 1..9 table, 10k object k (2 <= k <= 25); object 26 has 21, 27 has 31 and "
                 "so on: see labels"},
                {"objects", Json::array()}};
  for (const TrueObject& object : rendered.objects) scene["objects"].push_back(Describe(object));
  return scene;
}

void WriteSceneFolder(const RenderedScene& rendered, const std::string& id,
                      const std::string& folder) {
  const std::filesystem::path path(folder);
  std::filesystem::create_directories(path);
  const int width = rendered.depth.camera.width, height = rendered.depth.camera.height;
  imaging::WriteGray16Png((path / "depth.png").string(), {width, height, rendered.depth.counts});
  imaging::WriteRgbPng((path / "rgb.png").string(), rendered.color);
  imaging::WriteGray8Png((path / "labels.png").string(), {width, height, rendered.labels});
  WriteText(path / "scene.json", DescribeScene(rendered, id).dump(1) + "\n");
  WriteText(path / "scene.textproto", PrintScene(rendered.scene));
}

}  // namespace declutter
