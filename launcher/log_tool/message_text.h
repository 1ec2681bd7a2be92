#pragma once

#include <string>
#include <vector>

#include "modules/runtime/part.h"

namespace declutter::log_tool {

// The fields of a message of any of our types, a line each: its name and what it holds, of arrays
// the number of elements and the first few. One line that tells why when it is none of them or
// damaged.
std::vector<std::string> FieldLines(const runtime::Bytes& message);

}  // namespace declutter::log_tool
