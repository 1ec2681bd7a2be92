// Writes scene folders with known truth from a scene text.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "modules/scene_renderer/scene_folder.h"
#include "modules/scene_renderer/scene_renderer.h"
#include "modules/scene_renderer/scene_text.h"

namespace {

constexpr char kUsage[] =
    "usage: scene_renderer SCENE.textproto OUTDIR [--seed N] [--count M]\n"
    "                      [--noise real_sensor|white|none]\n"
    "Renders the scene into the folder OUTDIR: depth.png, rgb.png, labels.png, scene.json with "
    "the\n"
    "true objects and scene.textproto, the scene without chance. With --count the folders\n"
    "OUTDIR/0000 ... get the seeds N, N+1, ...; N is 1 unless given.\n";

constexpr int kFailure = 1, kBadInput = 2;
constexpr int kFolderDigits = 4;

struct Options {
  std::string scene, output, noise;
  uint64_t seed = 1;
  std::optional<uint64_t> count;
};

uint64_t ToNumber(const std::string& flag, const std::string& text) {
  const bool digits =
      !text.empty() && text.size() < 19 &&
      std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits) throw std::invalid_argument(flag + " " + text + " is not a whole number");
  return std::stoull(text);
}

Options ParseOptions(const std::vector<std::string>& arguments) {
  Options options;
  std::vector<std::string> places;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& flag = arguments[i];
    if (flag.rfind("--", 0) != 0) {
      places.push_back(flag);
      continue;
    }
    if (i + 1 == arguments.size()) throw std::invalid_argument(flag + " needs a value");
    const std::string& value = arguments[++i];
    if (flag == "--seed") {
      options.seed = ToNumber(flag, value);
    } else if (flag == "--count") {
      options.count = ToNumber(flag, value);
    } else if (flag == "--noise") {
      options.noise = value;
    } else {
      throw std::invalid_argument("unknown flag " + flag);
    }
  }
  if (places.size() != 2) throw std::invalid_argument("a scene and an output folder are needed");
  options.scene = places[0];
  options.output = places[1];
  return options;
}

declutter::Scene SceneOf(const Options& options) {
  declutter::Scene scene = declutter::ReadScene(options.scene);
  if (options.noise.empty()) return scene;
  // Checked as scene text is, under the flag's name.
  scene.mutable_noise()->MergeFrom(
      declutter::ParseScene("noise { model: \"" + options.noise + "\" }", "--noise").noise());
  return scene;
}

void RenderTo(const declutter::Scene& scene, uint64_t seed, const std::filesystem::path& folder) {
  const std::string name = std::filesystem::absolute(folder).lexically_normal().filename().string();
  declutter::WriteSceneFolder(declutter::Render(scene, seed), name, folder.string());
}

void RenderAll(const declutter::Scene& scene, const Options& options) {
  if (!options.count) return RenderTo(scene, options.seed, options.output);
  for (uint64_t i = 0; i < *options.count; ++i) {
    const std::string number = std::to_string(i);
    const size_t padding = kFolderDigits - std::min<size_t>(kFolderDigits, number.size());
    RenderTo(scene, options.seed + i,
             std::filesystem::path(options.output) / (std::string(padding, '0') + number));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (std::find(arguments.begin(), arguments.end(), "--help") != arguments.end()) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  try {
    const Options options = ParseOptions(arguments);
    const declutter::Scene scene = SceneOf(options);
    try {
      RenderAll(scene, options);
    } catch (const std::invalid_argument& fault) {
      throw std::invalid_argument(options.scene + ": " + fault.what());
    }
    return 0;
  } catch (const std::invalid_argument& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return kBadInput;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "scene_renderer: %s\n", fault.what());
    return kFailure;
  }
}
