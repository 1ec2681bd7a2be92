#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "modules/kinect_source/kinect_source.pb.h"
#include "modules/kinect_source/recording_reader.h"

namespace declutter {

// Decides when which frame leaves. Knows neither clock nor network: times are in seconds of any
// steady clock.
//
// Lossless: one frame in flight. A result with its utime releases the next; without one it is sent
// again, and after config.max_tries it is sent once more as an error, so that it still gets its
// line, before the source goes on. Otherwise: frames leave at config.rate_hz.
class KinectSource {
 public:
  // Gives frames until there is nothing left.
  using ReadFrame = std::function<std::optional<RecordedFrame>()>;

  KinectSource(const KinectSourceConfig& config, bool lossless, ReadFrame read_frame);

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
  bool ReadAhead();

  KinectSourceConfig config_;
  bool lossless_;
  ReadFrame read_frame_;
  std::optional<RecordedFrame> next_;
  bool at_end_ = false;
  std::optional<RecordedFrame> in_flight_;
  bool awaits_result_ = false;  // of in_flight_
  int num_tries_ = 0;
  double sent_s_ = 0;
  double due_s_ = 0;  // when the next frame may leave at config.rate_hz
};

}  // namespace declutter
