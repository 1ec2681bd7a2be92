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
  uint32_t current = 0;  // the byte that the points are in, and its bits so far
  uint32_t bits = 0;
  for (const FeaturePoint& point : points) {
    const auto pixel = static_cast<uint32_t>(point.pixel);
    bits = pixel / 8 == current ? bits : 0;
    current = pixel / 8;
    bits |= 1u << (pixel % 8);
    mask[current] = static_cast<uint8_t>(bits);
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

// The pixels set in a mask.
std::vector<int32_t> PixelsOf(const uint8_t* mask, size_t num_bytes, size_t expected) {
  std::vector<int32_t> pixels;
  pixels.reserve(expected);
  for (size_t byte = 0; byte < num_bytes; ++byte) {
    for (uint32_t bits = mask[byte]; bits != 0; bits &= bits - 1) {
      pixels.push_back(static_cast<int32_t>(8 * byte) + __builtin_ctz(bits));
    }
  }
  return pixels;
}

std::vector<int32_t> ReadMask(const std::vector<uint8_t>& bytes, const FeatureCloud& features,
                              size_t num_pixels, int32_t num_points) {
  std::vector<int32_t> pixels =
      PixelsOf(bytes.data(), MaskBytes(num_pixels), static_cast<size_t>(num_points));
  for (const int32_t p : pixels) {
    const bool is_kept =
        features.thinning == 1 || IsKept(p % features.width, p / features.width, features.thinning);
    if (is_kept && static_cast<size_t>(p) < num_pixels) continue;
    Check(false, {"data mask", static_cast<size_t>(p)}, 1,
          "must not be set: beyond the image or thinned out");
  }
  Check(pixels.size() == static_cast<size_t>(num_points), "num_points", num_points,
        "is not the number of pixels in the mask");
  return pixels;
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
    if (step == 1) return WritePoints(features, features.points, out);
    WritePoints(features, Thinned(features, step), out);
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
  const auto pixels = ReadMask(bytes, features, num_pixels, message.num_points);
  features.points = ReadFeaturePlanes(bytes.data() + mask_bytes, features.mode, steps,
                                      features.num_components, pixels);
  return features;
}

}  // namespace declutter::codec
