#pragma once

#include <vector>

#include "modules/plane_filter/plane_search.h"

namespace declutter {

// Indices of the candidates that are supports. First the main support: the plane that is large, in
// the middle of the image, roughly level and carries most; the floor carries less than the table
// that stands on it, a wall nothing. Then level planes parallel to it, largest first, without those
// over its hull: they are the tops of objects. Empty when there is no candidate.
std::vector<size_t> ChooseSupports(const InverseDepth& grid,
                                   const std::vector<PlaneCandidate>& candidates,
                                   const PlaneFilterConfig& config);

}  // namespace declutter
