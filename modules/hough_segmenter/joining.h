#pragma once

#include <vector>

#include "modules/hough_segmenter/side_voting.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// Occluders part what belongs together. Whether two parts do is for the depth image to say: these
// only propose it.

// All faces, and those that come of joining two on one line, at most max_joined.
std::vector<Face> WithJoinedFaces(const std::vector<Face>& faces, float max_extent,
                                  size_t max_joined);

// All patches, and those that come of joining two at the same height, of the same component or not,
// that are not farther than max_extent apart, at most max_joined.
std::vector<TopPatch> WithJoinedPatches(const std::vector<TopPatch>& tops, float max_extent,
                                        size_t max_joined);

}  // namespace declutter
