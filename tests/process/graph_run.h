#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/process/launched.h"

namespace declutter {

inline std::string Program(const std::string& name) {
  return std::filesystem::path(LAUNCHER).parent_path() / name;
}

// The whole graph over recordings, as a user runs it.
class GraphRun : public testing::Test {
 protected:
  // Renders a box and a cylinder that stand apart from each other, seen whole.
  std::string RenderScene(const std::string& name) {
    const std::string scene = folder_.Write("scene.textproto", R"(
object { box { size_x_m: 0.16 size_y_m: 0.08 size_z_m: 0.2 } x_m: -0.12 y_m: 0.65 yaw_rad: 0.5 }
object { cylinder { radius_m: 0.045 height_m: 0.15 } x_m: 0.12 y_m: 0.6 }
)");
    const std::string path = folder_.Path("scenes/" + name);
    EXPECT_EQ(Launched({Program("scene_renderer"), scene, path}, folder_).Wait().code, 0);
    return path;
  }

  Outcome Run(const std::string& input, const std::string& output,
              const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments = {"run", std::string(CONFIG_FOLDER) + "/" + graph_};
    if (!output.empty()) {
      arguments.insert(arguments.end(), {"--set", "object_exporter.output=" + output});
    }
    if (!input.empty()) {
      arguments.insert(arguments.end(), {"--set", "kinect_source.input=" + input});
    }
    arguments.insert(arguments.end(), options.begin(), options.end());
    return RunLauncher(arguments, folder_);
  }

  static std::vector<nlohmann::json> Lines(const std::string& output) {
    std::vector<nlohmann::json> lines;
    std::istringstream text(ReadFile(output + "/objects.jsonl"));
    for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }

  static std::vector<std::string> Frames(const std::string& output) {
    std::vector<std::string> frames;
    for (const nlohmann::json& line : Lines(output)) frames.push_back(line.at("frame"));
    return frames;
  }

  TemporaryFolder folder_;
  std::string scenes_ = folder_.Path("scenes");
  std::string output_ = folder_.Path("out");
  std::string graph_ = "recordings.textproto";
};

}  // namespace declutter
