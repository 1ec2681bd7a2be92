#include <memory>
#include <stdexcept>

#include "modules/codec/codec.h"
#include "modules/object_exporter/object_exporter.h"
#include "modules/runtime/bus.h"
#include "modules/runtime/run.h"

namespace declutter {
namespace {

class ObjectExporterModule {
 public:
  using Config = ObjectExporterConfig;

  ObjectExporterModule(const Config& config, runtime::Bus& bus) : bus_(bus) {
    bus.OnStart([this, config] { Open(config); });
    // What only pictures show is left alone where there are none.
    if (config.pictures()) {
      bus.Subscribe<depth_frame_t>(kDepthFrame, [this](const depth_frame_t& frame) {
        exporter_->AddDepth(codec::Decode(frame));
      });
      bus.Subscribe<color_frame_t>(kColorFrame, [this](const color_frame_t& frame) {
        exporter_->AddColor(frame.utime, codec::Decode(frame));
      });
    }
    if (config.pictures() && config.feature_pictures()) {
      bus.Subscribe<feature_cloud_t>(kFeatures, [this](const feature_cloud_t& features) {
        exporter_->AddFeatures(codec::Decode(features));
      });
    }
    bus.Subscribe<object_list_t>(
        kObjects, [this](const object_list_t& objects) { Export(codec::Decode(objects)); });
  }

 private:
  void Open(const Config& config) {
    try {
      exporter_ = std::make_unique<ObjectExporter>(config);
    } catch (const std::runtime_error& error) {
      throw runtime::ConfigError(error.what());
    }
  }

  void Export(const ObjectList& list) {
    try {
      exporter_->Export(list);
    } catch (const std::runtime_error& error) {
      bus_.Fail(error.what());
    }
  }

  runtime::Bus& bus_;
  std::unique_ptr<ObjectExporter> exporter_;
};

}  // namespace
}  // namespace declutter

int main(int argc, char** argv) {
  return declutter::runtime::Run<declutter::ObjectExporterModule>(argc, argv);
}
