#include <unistd.h>

#include "modules/runtime/run.h"
#include "tests/process/fake.pb.h"

namespace declutter {
namespace {

// Publishes frames 1, 2, ... each when the objects of the one before are out, or as a camera.
class FakeSource {
 public:
  using Config = FakeSourceConfig;

  FakeSource(const Config& config, runtime::Bus& bus)
      : config_(config), depth_(bus.Advertise(kDepthFrame)) {
    bus.Subscribe<object_list_t>(
        kObjects, [this](const object_list_t& objects) { released_ = objects.utime; });
    bus.Poll([this, &bus] { return Next(bus); });
  }

 private:
  std::optional<double> Next(runtime::Bus& bus) {
    const bool is_camera = config_.period_s() > 0;
    if (!is_camera && released_ < sent_) return 0.01;
    if (sent_ == config_.num_frames()) {
      if (config_.fails()) bus.Fail("an input is unreadable");
      return std::nullopt;
    }
    depth_frame_t frame = {};
    frame.utime = ++sent_;
    while (sent_ == config_.stuck_at()) pause();
    frame.num_bytes = config_.num_bytes();
    frame.data.resize(static_cast<size_t>(config_.num_bytes()));
    depth_.Publish(frame);
    return is_camera ? config_.period_s() : 0.01;
  }

  Config config_;
  runtime::Publisher<depth_frame_t> depth_;
  int64_t sent_ = 0;
  int64_t released_ = 0;
};

}  // namespace
}  // namespace declutter

int main(int argc, char** argv) {
  return declutter::runtime::Run<declutter::FakeSource>(argc, argv);
}
