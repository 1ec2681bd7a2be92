#include <algorithm>
#include <string>

#include "modules/codec/compression.h"
#include "modules/codec/feature_planes.h"
#include "modules/codec/frame_parts.h"
#include "modules/codec/thinning.h"

namespace declutter::codec {
namespace {

// component + 1 is coded in 16 bits.
constexpr int32_t kMaxComponents = 65535;

void DemandConsistent(const FeatureCloud& features) {
  const size_t num_pixels = DemandImageSize(features.width, features.height, features.header.error);
  const int num_components = features.num_components;
  Demand(num_components >= 0 && num_components <= kMaxComponents,
         std::to_string(num_components) + " components, at most 65535");
  int64_t previous_pixel = -1;
  bool in_order = true;
  bool in_component = true;
  for (const FeaturePoint& point : features.points) {
    in_order &= point.pixel > previous_pixel;
    in_component &= point.component >= -1 && point.component < num_components;
    previous_pixel = point.pixel;
  }
  Demand(in_order && previous_pixel < static_cast<int64_t>(num_pixels),
         "points that are not in row-major order of their pixels");
  Demand(in_component, "a point's component is not below num_components");
}

std::vector<FeaturePoint> Thinned(const FeatureCloud& features, int step) {
  std::vector<FeaturePoint> kept;
  for (const FeaturePoint& point : features.points) {
    if (IsKept(point.pixel % features.width, point.pixel / features.width, step)) {
      kept.push_back(point);
    }
  }
  return kept;
}

size_t MaskBytes(size_t num_pixels) { return (num_pixels + 7) / 8; }

// Bit p % 8 of byte p / 8 is pixel p.
std::vector<uint8_t> MakeMask(const std::vector<FeaturePoint>& points, size_t num_pixels) {
  std::vector<uint8_t> mask(MaskBytes(num_pixels));
  for (const FeaturePoint& point : points) {
    const auto pixel = static_cast<uint32_t>(point.pixel);
    mask[pixel / 8] = static_cast<uint8_t>(mask[pixel / 8] | (1u << (pixel % 8)));
  }
  return mask;
}

void WritePoints(const FeatureCloud& features, const std::vector<FeaturePoint>& points,
                 feature_cloud_t* message) {
  const auto num_pixels =
      static_cast<size_t>(features.width) * static_cast<size_t>(features.height);
  std::vector<uint8_t> bytes = MakeMask(points, num_pixels);
  AppendFeaturePlanes(points, features.mode, &bytes);
  if (!bytes.empty()) message->data = Compress(bytes.data(), bytes.size());
  message->num_points = static_cast<int32_t>(points.size());
  message->num_bytes = static_cast<int32_t>(message->data.size());
}

// Points at the pixels set in the mask, without features.
std::vector<FeaturePoint> ReadMask(const std::vector<uint8_t>& bytes, const FeatureCloud& features,
                                   size_t num_pixels, int32_t num_points) {
  std::vector<FeaturePoint> points;
  for (size_t pixel = 0; pixel < 8 * MaskBytes(num_pixels); ++pixel) {
    if ((bytes[pixel / 8] >> (pixel % 8) & 1) == 0) continue;
    const int p = static_cast<int>(pixel);
    Check(pixel < num_pixels && IsKept(p % features.width, p / features.width, features.thinning),
          {"data mask", pixel}, 1, "must not be set: beyond the image or thinned out");
    points.emplace_back().pixel = p;
  }
  Check(points.size() == static_cast<size_t>(num_points), "num_points", num_points,
        "is not the number of pixels in the mask");
  return points;
}

std::vector<uint8_t> DecompressExactly(const feature_cloud_t& message, size_t num_bytes) {
  CheckLength("data", message.data, "num_bytes", message.num_bytes);
  std::vector<uint8_t> bytes(num_bytes);
  const auto size = Decompress(message.data, bytes.data(), num_bytes);
  Check(size == num_bytes, "num_bytes", message.num_bytes,
        "data is not the coded mask and num_points points");
  return bytes;
}

double CheckStep(const char* name, double step) {
  Check(step > 0 && step <= 1, name, step, "must be in (0, 1]");
  return step;
}

}  // namespace

feature_cloud_t Encode(const FeatureCloud& features) {
  DemandConsistent(features);
  feature_cloud_t message{};
  WriteHeader(features.header, &message);
  message.mode = static_cast<int8_t>(features.mode);
  message.width = features.width;
  message.height = features.height;
  message.num_components = features.num_components;
  message.kappa_step = kKappaStep;
  message.curvature_step = kCurvatureStep;
  message.r_min_step_m = kRMinStep_m;
  const auto write = [&features](int step, feature_cloud_t* out) {
    WritePoints(features, step == 1 ? features.points : Thinned(features, step), out);
  };
  ThinUntilFitting(features.thinning, write, &message);
  return Fitting(std::move(message));
}

FeatureCloud Decode(const feature_cloud_t& message) {
  FeatureCloud features;
  features.header = ReadHeader(message);
  features.mode = Enumerator("mode", message.mode, FeatureMode::kPaper);
  const size_t num_pixels = CheckImageSize(message.width, message.height, message.error);
  features.width = message.width;
  features.height = message.height;
  features.thinning = CheckThinning(message.thinning);
  features.num_components = message.num_components;
  Check(message.num_components >= 0 && message.num_components <= kMaxComponents, "num_components",
        message.num_components, "must be in [0, 65535]");
  Check(message.num_points >= 0 && static_cast<size_t>(message.num_points) <= num_pixels,
        "num_points", message.num_points, "must be in [0, width * height]");
  const FeatureSteps steps{CheckStep("kappa_step", message.kappa_step),
                           CheckStep("curvature_step", message.curvature_step),
                           CheckStep("r_min_step_m", message.r_min_step_m)};
  const size_t mask_bytes = MaskBytes(num_pixels);
  const auto num_points = static_cast<size_t>(message.num_points);
  const auto bytes = DecompressExactly(message, mask_bytes + kNumFeaturePlanes * num_points);
  features.points = ReadMask(bytes, features, num_pixels, message.num_points);
  ReadFeaturePlanes(bytes.data() + mask_bytes, features.mode, steps, features.num_components,
                    &features.points);
  return features;
}

}  // namespace declutter::codec
