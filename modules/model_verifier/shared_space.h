#pragma once

#include "modules/geometry/solid.h"

namespace declutter {

// True when more than max_share of the volume of one of two solids lies inside the other, deeper
// than what their surfaces may be wrong.
bool ShareSpace(const Solid& a, const Solid& b, double max_share);

}  // namespace declutter
