#pragma once

#include <vector>

#include "modules/hough_segmenter/side_voting.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// Occluders part what belongs together. Whether two parts do is for the depth image to say: these
// only propose it.

// Appends to faces those that come of joining two on one line, at most max_joined.
void AppendJoinedFaces(float max_extent, size_t max_joined, std::vector<Face>* faces);

// Sets joined to what comes of joining two patches at the same height, of the same component or
// not, that are not farther than max_extent apart, at most max_joined.
void JoinPatches(const TopPatches& tops, float max_extent, size_t max_joined, TopPatches* joined);

}  // namespace declutter
