#include "modules/codec/checks.h"

#include <cmath>

#include "modules/geometry/image_limits.h"

namespace declutter::codec {

std::string Field::Text() const {
  return index < 0 ? name : std::string(name) + "[" + std::to_string(index) + "]";
}

void Demand(bool good, const std::string& rule) {
  if (!good) throw std::logic_error("cannot encode: " + rule);
}

double Finite(const Field& field, double value) {
  Check(std::isfinite(value), field, value, "must be finite");
  return value;
}

double Positive(const Field& field, double value) {
  Check(std::isfinite(value) && value > 0, field, value, "must be positive");
  return value;
}

float Fraction(const Field& field, float value) {
  Check(value >= 0 && value <= 1, field, value, "must be in [0, 1]");
  return value;
}

int32_t NotNegative(const Field& field, int32_t value) {
  Check(value >= 0, field, value, "must not be negative");
  return value;
}

size_t DemandImageSize(int width, int height, const std::string& error) {
  try {
    return CheckImageSize(width, height, error);
  } catch (const BadMessage& bad) {
    throw std::logic_error(std::string("cannot encode: ") + bad.what());
  }
}

size_t CheckImageSize(int32_t width, int32_t height, const std::string& error) {
  if (!error.empty()) {
    Check(width == 0, "width", width, "must be 0 in a frame with an error");
    Check(height == 0, "height", height, "must be 0 in a frame with an error");
    return 0;
  }
  const std::string rule = "must be in [1, " + std::to_string(kMaxImageSide_px) + "]";
  Check(width > 0 && width <= kMaxImageSide_px, "width", width, rule.c_str());
  Check(height > 0 && height <= kMaxImageSide_px, "height", height, rule.c_str());
  return static_cast<size_t>(width) * static_cast<size_t>(height);
}

}  // namespace declutter::codec
