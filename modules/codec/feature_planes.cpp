#include "modules/codec/feature_planes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/codec/checks.h"
#include "modules/codec/normal_code.h"

namespace declutter::codec {
namespace {

using PointBytes = std::array<uint8_t, kNumFeaturePlanes>;

int Quantised(float value, double step, int min, int max) {
  if (!std::isfinite(value)) throw std::logic_error("cannot encode: a feature is not finite");
  const double num_steps =
      std::clamp(value / step, static_cast<double>(min), static_cast<double>(max));
  return static_cast<int>(std::lround(num_steps));
}

uint8_t KappaByte(float kappa) {
  return static_cast<uint8_t>(Quantised(kappa, kKappaStep, -127, 127));
}

uint8_t CurvatureByte(float curvature) {
  return static_cast<uint8_t>(Quantised(curvature, kCurvatureStep, 0, 255));
}

uint8_t RMinByte(float r_min) {
  // A radius below half a step is still one.
  return static_cast<uint8_t>(Quantised(r_min, kRMinStep_m, r_min > 0 ? 1 : 0, 255));
}

PointBytes ToBytes(const FeaturePoint& point, FeatureMode mode) {
  if (!point.normal.allFinite()) throw std::logic_error("cannot encode: a normal is not finite");
  const NormalCode normal = EncodeNormal(point.normal);
  const bool paper = mode == FeatureMode::kPaper;
  const auto label = static_cast<uint32_t>(point.component + 1);
  return {static_cast<uint8_t>(normal[0]),
          static_cast<uint8_t>(normal[1]),
          paper ? CurvatureByte(point.curvature) : KappaByte(point.kappa),
          paper ? RMinByte(point.r_min) : CurvatureByte(point.curvature),
          static_cast<uint8_t>(label),
          static_cast<uint8_t>(label >> 8)};
}

float Value(uint8_t byte, double step) { return static_cast<float>(byte * step); }

// All but the pixel.
FeaturePoint ToPoint(const PointBytes& bytes, FeatureMode mode, const FeatureSteps& steps) {
  FeaturePoint point;
  point.normal = DecodeNormal({static_cast<int8_t>(bytes[0]), static_cast<int8_t>(bytes[1])});
  if (mode == FeatureMode::kPaper) {
    point.curvature = Value(bytes[2], steps.curvature);
    point.r_min = Value(bytes[3], steps.r_min_m);
  } else {
    point.kappa = static_cast<float>(static_cast<int8_t>(bytes[2]) * steps.kappa);
    point.curvature = Value(bytes[3], steps.curvature);
  }
  point.component = static_cast<int32_t>(bytes[4] | (bytes[5] << 8)) - 1;
  return point;
}

}  // namespace

void AppendFeaturePlanes(const std::vector<FeaturePoint>& points, FeatureMode mode,
                         std::vector<uint8_t>* bytes) {
  const size_t begin = bytes->size();
  bytes->resize(begin + kNumFeaturePlanes * points.size());
  PointBytes previous{};
  for (size_t i = 0; i < points.size(); ++i) {
    const PointBytes point = ToBytes(points[i], mode);
    for (size_t plane = 0; plane < kNumFeaturePlanes; ++plane) {
      (*bytes)[begin + plane * points.size() + i] =
          static_cast<uint8_t>(point[plane] - previous[plane]);
    }
    previous = point;
  }
}

void ReadFeaturePlanes(const uint8_t* planes, FeatureMode mode, const FeatureSteps& steps,
                       int32_t num_components, std::vector<FeaturePoint>* points) {
  PointBytes bytes{};
  for (size_t i = 0; i < points->size(); ++i) {
    for (size_t plane = 0; plane < kNumFeaturePlanes; ++plane) {
      bytes[plane] = static_cast<uint8_t>(bytes[plane] + planes[plane * points->size() + i]);
    }
    Check(IsNormalCode({static_cast<int8_t>(bytes[0]), static_cast<int8_t>(bytes[1])}),
          {"data normal", i}, static_cast<int>(bytes[0]), "is no code of a normal");
    FeaturePoint point = ToPoint(bytes, mode, steps);
    Check(point.component < num_components, {"data component", i}, point.component,
          "must be below num_components");
    point.pixel = (*points)[i].pixel;
    (*points)[i] = point;
  }
}

}  // namespace declutter::codec
