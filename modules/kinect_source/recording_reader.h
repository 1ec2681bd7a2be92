#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/kinect_source/kinect_source.pb.h"
#include "modules/kinect_source/recording_entry.h"

namespace declutter {

// A frame as it leaves the source.
struct RecordedFrame {
  DepthFrame depth;                 // header.error says why it has no image
  std::optional<ColorImage> color;  // registered to depth
  std::string color_error;          // why there is no colour image though there is a file
};

// Pose X_WC that the configuration gives the camera. Throws std::invalid_argument when its
// quaternion is not of unit length.
Eigen::Isometry3d CameraPose(const KinectSourceConfig& config);

// Reads the frames of a recording one by one: scene folders, depth PNGs or .pcd files.
class RecordingReader {
 public:
  // Lists the frames of config.input without reading them. Throws std::invalid_argument when there
  // is nothing to read or what all frames need is missing; what() names the folder or file.
  explicit RecordingReader(const KinectSourceConfig& config);

  // The next frame; nothing after the last one unless config.loop is set. A frame that cannot be
  // read comes with header.error, in which paths are below config.input.
  // Frames of a loop stay in memory where there are few.
  std::optional<RecordedFrame> Next();

  size_t num_frames() const { return entries_.size(); }

 private:
  RecordedFrame Read(const RecordingEntry& entry) const;
  std::string BelowInput(std::string text) const;

  std::string input_;
  bool loop_ = false;
  std::vector<RecordedFrame> kept_;  // of a loop: the first frames, in order
  size_t kept_bytes_ = 0;
  Eigen::Isometry3d X_WC_;
  std::vector<RecordingEntry> entries_;
  size_t next_ = 0;
  int64_t loop_offset_us_ = 0;
};

}  // namespace declutter
