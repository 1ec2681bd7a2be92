#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "modules/kinect_source/kinect_source.pb.h"
#include "modules/kinect_source/openni/openni_sensor.h"
#include "modules/kinect_source/recording_reader.h"

namespace declutter {

// Reads an .oni file frame by frame, none left out. Frames are named by their number in the file,
// six digits from 000000 on; utime is the file's.
class OniReader {
 public:
  // Throws NoSensor for a file that cannot be read, UnsupportedRequest for one without depth in a
  // format and size that fits, std::invalid_argument for a bad camera pose.
  OniReader(const KinectSourceConfig& config, const SensorRequest& request);

  // Nothing after the last frame, unless config.loop is set. A frame that cannot be read comes with
  // header.error.
  std::optional<RecordedFrame> Next();

 private:
  const bool loop_;
  const Eigen::Isometry3d X_WC_;
  std::unique_ptr<OpenniSensor> file_;
  int64_t num_read_ = 0;
  int64_t last_utime_ = 0;
};

}  // namespace declutter
