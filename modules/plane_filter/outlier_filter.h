#pragma once

#include "modules/plane_filter/inverse_depth.h"
#include "modules/plane_filter/plane_filter.pb.h"

namespace declutter {

// Marked pixels without statistical outliers (paper, section 3, step ii): a pixel's mean distance
// to its nearest marked neighbours in an image window, over its depth, must not exceed the average
// of all marked pixels by more than outlier_sigmas standard deviations.
PixelMask RemoveOutliers(const InverseDepth& image, const PixelMask& mask,
                         const PlaneFilterConfig& config);

}  // namespace declutter
