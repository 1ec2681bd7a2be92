#pragma once

#include <string>

#include "modules/geometry/solid.h"

namespace declutter {

// One line of objects.jsonl, without its end: frame, utime, error when there is one, support planes
// and objects as a JSON object. Metres, poses in C, six decimals. `picture_name` is what the
// frame's pictures begin with; empty when there are none.
std::string ObjectLine(const ObjectList& list, const std::string& picture_name);

}  // namespace declutter
