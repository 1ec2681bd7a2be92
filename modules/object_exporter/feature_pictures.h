#pragma once

#include <optional>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/feature_cloud.h"

namespace declutter {

// The features that tell flat from round, red where they are low and blue where they are high
// (paper, Figure 5); black where there is no object point.
struct FeaturePictures {
  ColorImage curvature;  // 0 to 0.02; horizontal curvature, 0 to 12 /m, in default mode
  ColorImage r_min;      // 0 to 0.12 m; in default mode the radius of the horizontal curvature
};

// At the size of the depth image, or of the sensor's image that it was decimated from.
FeaturePictures DrawFeatures(const FeatureCloud& features,
                             const std::optional<Decimation>& decimation);

}  // namespace declutter
