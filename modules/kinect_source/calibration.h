#pragma once

#include <memory>
#include <optional>

#include "modules/kinect_source/camera_file.h"
#include "modules/kinect_source/kinect_source.pb.h"
#include "modules/kinect_source/recording_reader.h"
#include "modules/kinect_source/rectification.h"

namespace declutter {

// Makes up for what is known of a sensor: its intrinsics and lens from config.intrinsics_file, its
// depth by z := config.depth_scale * z + config.depth_offset_m.
class Calibration {
 public:
  // has_intrinsics: the frames come with intrinsics of their own that the file does not replace.
  // Throws std::invalid_argument when the file cannot be used.
  Calibration(const KinectSourceConfig& config, bool has_intrinsics);

  // A frame of another size than the file's gets header.error.
  void Apply(RecordedFrame* frame) const;

  // The file's camera; none when there is no file, or it does not count.
  const std::optional<CameraFile>& file() const { return file_; }

 private:
  void CorrectDepth(DepthImage* image) const;

  const double depth_scale_;
  const double depth_offset_m_;
  std::optional<CameraFile> file_;
  std::shared_ptr<const Rectification> rectification_;
};

}  // namespace declutter
