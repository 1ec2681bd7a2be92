#pragma once

#include <vector>

#include "modules/hough_segmenter/side_voting.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// Occluders part what belongs together. Whether two parts do is for the depth image to say: these
// only propose it.

// All faces, and those that come of joining two on one line.
std::vector<Face> WithJoinedFaces(const std::vector<Face>& faces, float max_extent);

// All patches, and those that come of joining two at the same height, of the same component or not.
std::vector<TopPatch> WithJoinedPatches(const std::vector<TopPatch>& tops);

}  // namespace declutter
