#include "modules/object_exporter/feature_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/imaging/canvas.h"

namespace declutter {
namespace {

using imaging::Canvas;
using imaging::Rgb;

// Twice what divides flat from round, and the widest radius of a cylinder.
constexpr float kMaxCurvature = 0.02f;  // [1]
constexpr float kMaxKappa = 12.0f;      // [1/m]
constexpr float kMaxRadius = 0.12f;     // [m]

// From red over yellow, green and cyan to blue as share goes from 0 to 1.
Rgb Rainbow(float share) {
  const float hue = 4 * std::clamp(share, 0.0f, 1.0f);  // [60 degrees]
  const auto channel = [hue](float center) {
    return static_cast<uint8_t>(
        std::lround(255 * std::clamp(2 - std::abs(hue - center), 0.0f, 1.0f)));
  };
  return {channel(0), channel(2), channel(4)};
}

Canvas BlackCanvas(const FeatureCloud& features, const std::optional<Decimation>& decimation) {
  const int width = decimation ? decimation->sensor_width : features.width;
  const int height = decimation ? decimation->sensor_height : features.height;
  const size_t num_values = 3 * static_cast<size_t>(width) * static_cast<size_t>(height);
  return Canvas({width, height, std::vector<uint8_t>(num_values)});
}

float KappaRadius(float kappa) {
  return kappa > 0 ? 1 / kappa : std::numeric_limits<float>::infinity();
}

}  // namespace

FeaturePictures DrawFeatures(const FeatureCloud& features,
                             const std::optional<Decimation>& decimation) {
  const bool is_paper = features.mode == FeatureMode::kPaper;
  const int step = decimation ? decimation->step : 1;
  const int side = step * features.thinning;
  Canvas curvature = BlackCanvas(features, decimation);
  Canvas r_min = curvature;
  for (const FeaturePoint& point : features.points) {
    const int u = step * (point.pixel % features.width);
    const int v = step * (point.pixel / features.width);
    const float share =
        is_paper ? point.curvature / kMaxCurvature : std::abs(point.kappa) / kMaxKappa;
    const float radius = is_paper ? point.r_min : KappaRadius(std::abs(point.kappa));
    curvature.FillRectangle(u, v, side, side, Rainbow(share));
    r_min.FillRectangle(u, v, side, side, Rainbow(radius / kMaxRadius));
  }
  return {curvature.image(), r_min.image()};
}

}  // namespace declutter
