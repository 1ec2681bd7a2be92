#pragma once

#include <string>
#include <vector>

#include "launcher/wiring.h"

namespace declutter::launcher {

// The modules and the channels between them as a drawing for Graphviz; dashed is what releases a
// source.
std::string Dot(const std::vector<WiredModule>& modules);

}  // namespace declutter::launcher
