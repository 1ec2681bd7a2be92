#include "modules/kinect_source/color_match.h"

#include <cstdlib>
#include <utility>

namespace declutter {
namespace {

constexpr size_t kMaxColors = 2;

}  // namespace

void ColorMatch::AddColor(int64_t device_us, ColorImage image) {
  if (colors_.size() == kMaxColors) colors_.pop_front();
  colors_.push_back({device_us, std::move(image)});
}

std::optional<SensorFrame> ColorMatch::AddDepth(SensorFrame depth) {
  std::optional<SensorFrame> before = std::move(waiting_);
  waiting_ = std::move(depth);
  return before;
}

std::optional<SensorFrame> ColorMatch::Take() {
  if (!waiting_) return std::nullopt;
  const bool is_late =
      !colors_.empty() && colors_.back().device_us > waiting_->device_us + tolerance_us_;
  if (!FindColor() && !is_late) return std::nullopt;
  return TakeAnyhow();
}

std::optional<SensorFrame> ColorMatch::TakeAnyhow() {
  return std::exchange(waiting_, std::nullopt);
}

bool ColorMatch::FindColor() {
  Color* best = nullptr;
  for (Color& color : colors_) {
    const auto distance_us = [this](const Color& c) {
      return std::abs(c.device_us - waiting_->device_us);
    };
    if (distance_us(color) > tolerance_us_) continue;
    if (best == nullptr || distance_us(color) < distance_us(*best)) best = &color;
  }
  if (best == nullptr) return false;
  waiting_->color = best->image;
  return true;
}

}  // namespace declutter
