#include "modules/kinect_source/recording_reader.h"

#include <cmath>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "modules/kinect_source/png_sequence.h"
#include "modules/kinect_source/point_clouds.h"
#include "modules/kinect_source/scene_folders.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxQuaternionError = 0.01;
constexpr size_t kMaxKeptBytes = 64 << 20;  // of images, 40 frames of 640 x 480 px with colour

std::vector<RecordingEntry> ListFrames(const KinectSourceConfig& config) {
  const fs::path input = config.input();
  std::error_code error;
  if (!fs::exists(input, error)) {
    throw std::invalid_argument(input.string() + ": no such file or folder");
  }
  auto entries = fs::is_directory(input, error) ? ListSceneFolders(input, config.depth_file())
                                                : std::vector<RecordingEntry>();
  if (entries.empty()) entries = ListPointClouds(input, config.intrinsics_file());
  if (entries.empty()) entries = ListPngSequence(input, config.intrinsics_file());
  if (entries.empty()) {
    throw std::invalid_argument(input.string() +
                                ": nothing to read: no folder with scene.json or " +
                                config.depth_file() + " at or below it, no .pcd and no .png file");
  }
  return entries;
}

}  // namespace

Eigen::Isometry3d CameraPose(const KinectSourceConfig& config) {
  const Eigen::Quaterniond q_WC(config.camera_qw(), config.camera_qx(), config.camera_qy(),
                                config.camera_qz());
  if (!(std::abs(q_WC.norm() - 1) <= kMaxQuaternionError)) {
    throw std::invalid_argument("camera_qw, camera_qx, camera_qy, camera_qz have length " +
                                std::to_string(q_WC.norm()) + ", a unit quaternion has 1");
  }
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() = q_WC.normalized().toRotationMatrix();
  X_WC.translation() =
      Eigen::Vector3d(config.camera_x_m(), config.camera_y_m(), config.camera_z_m());
  return X_WC;
}

RecordingReader::RecordingReader(const KinectSourceConfig& config)
    : input_(config.input()),
      loop_(config.loop()),
      X_WC_(CameraPose(config)),
      entries_(ListFrames(config)) {}

std::optional<RecordedFrame> RecordingReader::Next() {
  if (next_ == entries_.size()) {
    if (!loop_) return std::nullopt;
    loop_offset_us_ += entries_.back().utime - entries_.front().utime + kFramePeriodUs;
    next_ = 0;
  }
  const size_t index = next_++;
  RecordedFrame frame = index < kept_.size() ? kept_[index] : Read(entries_[index]);
  const size_t num_bytes =
      2 * frame.depth.image.counts.size() + (frame.color ? frame.color->rgb.size() : 0);
  if (loop_ && index == kept_.size() && kept_bytes_ + num_bytes <= kMaxKeptBytes) {
    kept_.push_back(frame);
    kept_bytes_ += num_bytes;
  }
  frame.depth.header.utime += loop_offset_us_;
  return frame;
}

RecordedFrame RecordingReader::Read(const RecordingEntry& entry) const {
  RecordedFrame frame;
  frame.depth.header.utime = entry.utime;
  frame.depth.header.frame = entry.name;
  frame.depth.X_WC = X_WC_;
  try {
    FrameContent content = entry.load();
    frame.depth.image = std::move(content.depth);
    frame.color = std::move(content.color);
    frame.color_error = BelowInput(std::move(content.color_error));
  } catch (const std::runtime_error& error) {
    frame.depth.header.error = BelowInput(error.what());
  } catch (const std::bad_alloc&) {
    frame.depth.header.error = "too large for the memory of this machine";
  }
  return frame;
}

// Results should not depend on where a recording lies.
std::string RecordingReader::BelowInput(std::string text) const {
  if (text.compare(0, input_.size() + 1, input_ + ":") == 0) {  // a single file
    return fs::path(input_).filename().string() + text.substr(input_.size());
  }
  const std::string prefix = input_.back() == '/' ? input_ : input_ + "/";
  if (text.compare(0, prefix.size(), prefix) == 0) text.erase(0, prefix.size());
  return text;
}

}  // namespace declutter
