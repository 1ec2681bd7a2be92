#pragma once

#include <optional>

#include "modules/hough_segmenter/model_fits.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// The circle that most of the free edge of a patch lies on, and that the whole patch lies in;
// nothing when there is none or when the edge is too short to tell it from a straight one. Centre
// and radius only.
std::optional<CircleModel> FitDisc(const TopPatch& patch, float min_radius_m, float max_radius_m);

}  // namespace declutter
