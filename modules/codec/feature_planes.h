#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/geometry/feature_cloud.h"

// The features of n points as byte planes of n bytes each, one feature after the other: normal (two
// planes, normal_code.h), then in default mode kappa, curvature, in paper mode curvature, r_min,
// then component + 1 (low byte, high byte). Each byte is the difference from that of the point
// before, which is small where the surface is smooth.
namespace declutter::codec {

inline constexpr size_t kNumFeaturePlanes = 6;

// Quantisation. What exceeds a byte's range is saturated.
inline constexpr double kKappaStep = 0.5;         // [1/m] signed: up to +-63.5
inline constexpr double kCurvatureStep = 0.0005;  // [1] up to 0.1275
inline constexpr double kRMinStep_m = 0.001;      // [m] up to 0.255; 0 is not computed

struct FeatureSteps {
  double kappa = kKappaStep;
  double curvature = kCurvatureStep;
  double r_min_m = kRMinStep_m;
};

// Appends the planes to bytes. Throws std::logic_error when a feature is not finite.
void AppendFeaturePlanes(const std::vector<FeaturePoint>& points, FeatureMode mode,
                         std::vector<uint8_t>* bytes);

// The points at these pixels, from their planes, kNumFeaturePlanes * pixels.size() bytes. Throws
// BadMessage when a normal or a component cannot be meant.
std::vector<FeaturePoint> ReadFeaturePlanes(const uint8_t* planes, FeatureMode mode,
                                            const FeatureSteps& steps, int32_t num_components,
                                            const std::vector<int32_t>& pixels);

}  // namespace declutter::codec
