#pragma once

#include <string>

namespace declutter {

// Why the last call of OpenNI2 failed, on one line.
std::string OpenniError();

}  // namespace declutter
