#include "modules/kinect_source/png_sequence.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "modules/kinect_source/camera_file.h"
#include "modules/kinect_source/file_listing.h"
#include "modules/kinect_source/frame_files.h"
#include "modules/kinect_source/rectification.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;

constexpr double kTumDepthScaleM = 1.0 / 5000;
constexpr int64_t kMaxColorDelayUs = 20'000;

// An image of a sequence and its time, when it has one.
struct TimedFile {
  fs::path path;
  std::optional<int64_t> utime;  // [us]
};

// Microseconds of "1305031102.160407"; nothing when `text` is not seconds with a decimal point.
// Digits are not read as floating point, which would lose the last ones.
std::optional<int64_t> ParseTime(const std::string& text) {
  const size_t point = text.find('.');
  if (point == 0 || point == std::string::npos || point > 12) return std::nullopt;
  const std::string whole = text.substr(0, point);
  std::string fraction = text.substr(point + 1, 6);
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (!std::all_of(whole.begin(), whole.end(), is_digit) ||
      !std::all_of(text.begin() + static_cast<std::ptrdiff_t>(point) + 1, text.end(), is_digit)) {
    return std::nullopt;
  }
  fraction.resize(6, '0');
  return std::stoll(whole) * 1'000'000 + std::stoll(fraction);
}

// Lines of "seconds file", # begins a comment.
std::vector<TimedFile> ReadList(const fs::path& list) {
  std::vector<TimedFile> files;
  std::ifstream stream(list);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string time;
    std::string file;
    if (!(words >> time)) continue;
    const auto utime = ParseTime(time.find('.') == std::string::npos ? time + ".0" : time);
    if (!utime || !(words >> file)) {
      throw std::invalid_argument(list.string() + ":" + std::to_string(number) +
                                  ": a line must be a time in seconds and a file name");
    }
    files.push_back({list.parent_path() / file, utime});
  }
  return files;
}

// kind is "depth" or "rgb".
std::vector<TimedFile> ListImages(const fs::path& input, const std::string& kind) {
  const fs::path list = input / (kind + ".txt");
  std::error_code ignored;
  if (fs::is_regular_file(list, ignored)) return ReadList(list);
  std::vector<fs::path> paths = ListFiles(input / kind, ".png");
  if (paths.empty() && kind == "depth") paths = ListFiles(input, ".png");
  std::vector<TimedFile> files;
  for (const fs::path& path : paths) files.push_back({path, ParseTime(path.stem().string())});
  return files;
}

// Gives every frame a time, later than that of the frame before.
void SetTimes(std::vector<TimedFile>* depths) {
  const bool all_timed = std::all_of(depths->begin(), depths->end(),
                                     [](const TimedFile& file) { return file.utime.has_value(); });
  if (!all_timed) {
    for (size_t i = 0; i < depths->size(); ++i) {
      (*depths)[i].utime = static_cast<int64_t>(i) * kFramePeriodUs;
    }
    return;
  }
  std::stable_sort(depths->begin(), depths->end(),
                   [](const TimedFile& a, const TimedFile& b) { return *a.utime < *b.utime; });
  for (size_t i = 1; i < depths->size(); ++i) {
    (*depths)[i].utime = std::max(*(*depths)[i].utime, *(*depths)[i - 1].utime + 1);
  }
}

// The colour image that belongs to a depth image; empty when there is none.
fs::path FindColor(const TimedFile& depth, const std::vector<TimedFile>& colors) {
  fs::path nearest;
  int64_t min_delay_us = kMaxColorDelayUs + 1;
  for (const TimedFile& color : colors) {
    if (color.path.filename() == depth.path.filename()) return color.path;
    if (!color.utime) continue;
    const int64_t delay_us = std::abs(*color.utime - *depth.utime);
    if (delay_us >= min_delay_us) continue;
    min_delay_us = delay_us;
    nearest = color.path;
  }
  return nearest;
}

CameraFile ReadCamera(const fs::path& path) {
  try {
    return ReadCameraFile(path);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(std::string(error.what()) +
                                " (depth PNGs need the camera's intrinsics: intrinsics_file, or "
                                "intrinsics.json beside them)");
  }
}

}  // namespace

std::vector<RecordingEntry> ListPngSequence(const fs::path& input,
                                            const std::string& intrinsics_file) {
  std::vector<TimedFile> depths = ListImages(input, "depth");
  if (depths.empty()) return {};
  const CameraFile file = ReadCamera(IntrinsicsPath(input, intrinsics_file));
  const double depth_scale_m = file.depth_scale_m.value_or(kTumDepthScaleM);
  const auto rectification = RectificationOf(file);
  const std::vector<TimedFile> colors = ListImages(input, "rgb");
  SetTimes(&depths);
  std::vector<RecordingEntry> entries;
  for (const TimedFile& depth : depths) {
    const fs::path color = FindColor(depth, colors);
    const auto load = [path = depth.path, color, camera = file.camera, depth_scale_m,
                       rectification] {
      FrameContent content;
      content.depth = ReadDepthImage(path, camera, depth_scale_m);
      if (!color.empty()) ReadColorImage(color, &content);
      if (rectification) rectification->Apply(&content.depth);
      if (rectification && content.color) rectification->Apply(&*content.color);
      return content;
    };
    entries.push_back({depth.path.stem().string(), *depth.utime, load});
  }
  return entries;
}

}  // namespace declutter
