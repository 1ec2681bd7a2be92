#include "modules/kinect_source/scene_folders.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "modules/kinect_source/camera_file.h"
#include "modules/kinect_source/frame_files.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;

struct FoundFolder {
  std::string path_below_input;
  std::string error;  // why it cannot be listed
};

bool IsScene(const fs::path& folder, const std::string& depth_file) {
  std::error_code ignored;
  return fs::is_regular_file(folder / "scene.json", ignored) ||
         fs::is_regular_file(folder / depth_file, ignored);
}

// `above` are the folders on the way down, which a link must not lead back to.
void Search(const fs::path& input, const fs::path& below, const std::string& depth_file,
            std::vector<fs::path> above, std::vector<FoundFolder>* found) {
  const fs::path folder = input / below;
  std::error_code error;
  const fs::path canonical = fs::canonical(folder, error);
  if (!error && std::count(above.begin(), above.end(), canonical) > 0) return;
  above.push_back(canonical);

  if (IsScene(folder, depth_file)) found->push_back({below.string(), ""});
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    if (!entry->is_directory(ignored)) continue;
    Search(input, below / entry->path().filename(), depth_file, above, found);
  }
  if (error) found->push_back({below.string(), error.message()});
}

FrameContent LoadScene(const fs::path& folder, const std::string& depth_file) {
  const CameraFile file = ReadCameraFile(folder / "scene.json");
  if (!file.depth_scale_m) {
    throw std::runtime_error((folder / "scene.json").string() + ": depth_scale_m is missing");
  }
  FrameContent content;
  content.depth = ReadDepthImage(folder / depth_file, file.camera, *file.depth_scale_m);
  if (fs::exists(folder / "rgb.png")) ReadColorImage(folder / "rgb.png", &content);
  return content;
}

std::string FrameName(const fs::path& input, std::string path_below_input) {
  if (path_below_input.empty()) {
    const fs::path own = fs::absolute(input).lexically_normal();
    return own.has_filename() ? own.filename().string() : own.parent_path().filename().string();
  }
  std::replace(path_below_input.begin(), path_below_input.end(), '/', '_');
  return path_below_input;
}

RecordingEntry EntryOf(const fs::path& input, const FoundFolder& found,
                       const std::string& depth_file, size_t index) {
  RecordingEntry entry;
  entry.name = FrameName(input, found.path_below_input);
  entry.utime = static_cast<int64_t>(index) * kFramePeriodUs;
  const fs::path folder = found.path_below_input.empty() ? input : input / found.path_below_input;
  if (found.error.empty()) {
    entry.load = [folder, depth_file] { return LoadScene(folder, depth_file); };
  } else {
    entry.load = [text = folder.string() + ": " + found.error]() -> FrameContent {
      throw std::runtime_error(text);
    };
  }
  return entry;
}

}  // namespace

std::vector<RecordingEntry> ListSceneFolders(const fs::path& input, const std::string& depth_file) {
  std::vector<FoundFolder> found;
  if (IsScene(input, depth_file)) {
    found.push_back({"", ""});
  } else {
    Search(input, "", depth_file, {}, &found);
  }
  std::sort(found.begin(), found.end(), [](const FoundFolder& a, const FoundFolder& b) {
    return a.path_below_input < b.path_below_input;
  });
  std::vector<RecordingEntry> entries;
  for (const FoundFolder& folder : found) {
    entries.push_back(EntryOf(input, folder, depth_file, entries.size()));
  }
  return entries;
}

}  // namespace declutter
