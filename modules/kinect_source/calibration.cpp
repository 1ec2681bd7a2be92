#include "modules/kinect_source/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace declutter {

Calibration::Calibration(const KinectSourceConfig& config, bool has_intrinsics)
    : depth_scale_(config.depth_scale()), depth_offset_m_(config.depth_offset_m()) {
  if (has_intrinsics || config.intrinsics_file().empty()) return;
  try {
    file_ = ReadCameraFile(config.intrinsics_file());
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
  rectification_ = RectificationOf(*file_);
}

void Calibration::Apply(RecordedFrame* frame) const {
  DepthImage& image = frame->depth.image;
  if (image.empty()) return;
  CorrectDepth(&image);
  if (!file_) return;
  if (image.camera.width != file_->camera.width || image.camera.height != file_->camera.height) {
    frame->depth.header.error = "the intrinsics file is for another size than the image's " +
                                std::to_string(image.camera.width) + "x" +
                                std::to_string(image.camera.height) + " px";
    image = {};
    frame->color.reset();
    return;
  }
  image.camera = file_->camera;
  if (!rectification_) return;
  rectification_->Apply(&image);
  if (frame->color) rectification_->Apply(&*frame->color);
}

void Calibration::CorrectDepth(DepthImage* image) const {
  if (depth_scale_ == 1 && depth_offset_m_ == 0) return;
  constexpr double kMaxCount = std::numeric_limits<uint16_t>::max();
  const double offset = depth_offset_m_ / image->depth_scale_m;
  for (uint16_t& count : image->counts) {
    if (count == 0) continue;
    count = static_cast<uint16_t>(
        std::clamp(std::round(depth_scale_ * count + offset), 0.0, kMaxCount));
  }
}

}  // namespace declutter
