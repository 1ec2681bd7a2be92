#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "modules/codec/codec.h"
#include "modules/kinect_source/kinect_source.h"
#include "modules/kinect_source/openni/input.h"
#include "modules/runtime/bus.h"
#include "modules/runtime/run.h"

namespace declutter {
namespace {

// How late the end of the recording may be noticed.
constexpr double kMaxWaitS = 0.05;

double SteadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Microseconds since 1970 that go on evenly when the wall clock is set.
LiveReader::Now EvenWallClock() {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  const auto wall_us = std::chrono::duration_cast<std::chrono::microseconds>(since_1970).count();
  const double start_s = SteadySeconds();
  return [wall_us, start_s] {
    return wall_us + static_cast<int64_t>(1e6 * (SteadySeconds() - start_s));
  };
}

class KinectSourceModule {
 public:
  using Config = KinectSourceConfig;

  KinectSourceModule(const Config& config, runtime::Bus& bus)
      : bus_(bus), depth_(bus.Advertise(kDepthFrame)), color_(bus.Advertise(kColorFrame)) {
    bus.OnStart([this, config] { Open(config); });
    bus.Subscribe<object_list_t>(kObjects, [this](const object_list_t& objects) {
      source_->OnResult(objects.utime);
      Advance();
    });
    bus.Poll([this] { return Advance(); });
  }

 private:
  void Open(const Config& config) {
    try {
      Input input = OpenInput(config, EvenWallClock(), Events());
      source_ = std::make_unique<KinectSource>(config, bus_.lossless(), input.kind, input.read);
    } catch (const std::invalid_argument& error) {
      throw runtime::ConfigError(error.what());
    }
  }

  SensorEvents Events() {
    return {[this](const std::string& text) { bus_.SetTrouble(text); },
            [this](int64_t num_frames) { bus_.CountSkipped(num_frames); },
            [this](const std::string& why) { bus_.Reject("sensor", why); },
            [this](const std::string& text) { bus_.Fail(text); },
            [this](const std::string& text) { bus_.Note(text); }};
  }

  std::optional<double> Advance() {
    const KinectSource::Step step = source_->Advance(SteadySeconds());
    if (!step.failure.empty()) bus_.Fail(step.failure);
    if (step.publish != nullptr) Publish(*step.publish);
    if (!step.wait_s) return std::nullopt;
    return std::min(*step.wait_s, kMaxWaitS);
  }

  void Publish(const RecordedFrame& frame) {
    const FrameHeader& header = frame.depth.header;
    try {
      if (frame.color) color_.Publish(codec::Encode(header, *frame.color));
    } catch (const codec::MessageTooLarge& error) {
      bus_.Fail(header.frame + ": " + error.what());
    }
    depth_.Publish(Encode(frame.depth));
  }

  // A frame that does not fit on the wire becomes one that says so, and gets its result as others.
  depth_frame_t Encode(const DepthFrame& frame) {
    try {
      depth_frame_t message = codec::Encode(frame);
      if (message.decimation > 1) SayDecimated(message);
      return message;
    } catch (const codec::MessageTooLarge& error) {
      DepthFrame unsent{frame.header, {}, frame.X_WC};
      unsent.header.error = error.what();
      bus_.Fail(unsent.header.frame + ": " + unsent.header.error);
      return codec::Encode(unsent);
    }
  }

  // Once: what holds for one frame of a recording holds for most.
  void SayDecimated(const depth_frame_t& message) {
    if (said_decimated_) return;
    said_decimated_ = true;
    const std::string nth = message.decimation == 2   ? "2nd"
                            : message.decimation == 3 ? "3rd"
                                                      : std::to_string(message.decimation) + "th";
    bus_.Warn("decimation", "depth image " + std::to_string(message.sensor_width) + "x" +
                                std::to_string(message.sensor_height) +
                                " does not fit into a message: every " + nth +
                                " row and column is sent");
  }

  runtime::Bus& bus_;
  runtime::Publisher<depth_frame_t> depth_;
  runtime::Publisher<color_frame_t> color_;
  std::unique_ptr<KinectSource> source_;
  bool said_decimated_ = false;
};

}  // namespace
}  // namespace declutter

int main(int argc, char** argv) {
  return declutter::runtime::Run<declutter::KinectSourceModule>(argc, argv);
}
