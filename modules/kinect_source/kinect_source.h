#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "modules/kinect_source/kinect_source.pb.h"
#include "modules/kinect_source/recording_reader.h"

namespace declutter {

// What reading a frame gives.
struct ReadResult {
  std::optional<RecordedFrame> frame;
  double wait_s = 0;    // without a frame: when to read again
  bool at_end = false;  // no further frame
};

// Decides when which frame leaves. Knows neither clock nor network: times are in seconds of any
// steady clock.
//
// Lossless: one frame in flight. A result with its utime releases the next; without one it is sent
// again, and after config.max_tries it is sent once more as an error, so that it still gets its
// line, before the source goes on. Otherwise: frames of a recording leave at config.rate_hz, or as
// far apart as they were taken; those of a sensor when they come. A sensor is not read before its
// frame can leave, so that it is the newest.
class KinectSource {
 public:
  enum class Input { kRecording, kSensor };
  using ReadFrame = std::function<ReadResult()>;

  KinectSource(const KinectSourceConfig& config, bool lossless, Input input, ReadFrame read_frame);

  struct Step {
    const RecordedFrame* publish = nullptr;  // valid until the next call; null: nothing now
    std::string failure;                     // what went wrong for good; empty: nothing
    std::optional<double> wait_s;            // until the next step at the latest; none: finished
  };

  // What to do now.
  Step Advance(double now_s);

  // A result with this utime has arrived.
  void OnResult(int64_t utime);

 private:
  Step Begin(double now_s);
  Step Resend(double now_s);
  void ReadNext();
  double PeriodUntil(const RecordedFrame& next) const;

  KinectSourceConfig config_;
  bool lossless_;
  Input input_;
  ReadFrame read_frame_;
  std::optional<RecordedFrame> next_;
  int64_t num_read_ = 0;
  double read_again_s_ = 0;  // from now; while there is no next_
  bool at_end_ = false;
  std::optional<RecordedFrame> in_flight_;
  bool awaits_result_ = false;  // of in_flight_
  int num_tries_ = 0;
  double sent_s_ = 0;
  double due_s_ = 0;  // when in_flight_ was due to leave
};

}  // namespace declutter
