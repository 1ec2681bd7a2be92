#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "modules/runtime/run.h"
#include "tests/process/fake.pb.h"

namespace declutter {
namespace {

// Answers each depth image with an empty list of objects, until its mishap.
class FakeFilter {
 public:
  using Config = FakeFilterConfig;

  FakeFilter(const Config& config, runtime::Bus& bus)
      : config_(config), objects_(bus.Advertise(kObjects)) {
    if (config_.mishap() == "hangs_at_start") Hang();
    bus.OnStart([this] {
      if (config_.mishap() == "crashes_at_start") std::raise(SIGSEGV);
    });
    bus.Subscribe<depth_frame_t>(kDepthFrame,
                                 [this, &bus](const depth_frame_t& frame) { Answer(frame, bus); });
  }

 private:
  static void Hang() {
    for (;;) pause();
  }

  void Answer(const depth_frame_t& frame, runtime::Bus& bus) {
    if (frame.utime >= config_.at_frame() &&
        frame.utime < config_.at_frame() + config_.num_frames()) {
      if (config_.mishap() == "crashes") std::raise(SIGSEGV);
      if (config_.mishap() == "refuses") throw runtime::ConfigError("not with these parameters");
      if (config_.mishap() == "fills_stdout") {
        const std::string line(999, '-');
        for (int i = 0; i < 25'000; ++i) std::puts(line.c_str());
      }
      if (config_.mishap() == "gets_stuck") {
        bus.Warn("mishap", "stuck");
        Hang();
      }
    }
    object_list_t objects = {};
    objects.utime = frame.utime;
    objects_.Publish(objects);
  }

  Config config_;
  runtime::Publisher<object_list_t> objects_;
};

}  // namespace
}  // namespace declutter

int main(int argc, char** argv) {
  return declutter::runtime::Run<declutter::FakeFilter>(argc, argv);
}
