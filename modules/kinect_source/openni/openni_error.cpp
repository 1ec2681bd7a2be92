#include "modules/kinect_source/openni/openni_error.h"

#include <OpenNI.h>

#include <sstream>

namespace declutter {

std::string OpenniError() {
  std::istringstream lines(openni::OpenNI::getExtendedError());
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    line.erase(0, line.find_first_not_of(" \t"));
    if (!line.empty()) text += (text.empty() ? "" : "; ") + line;
  }
  return text.empty() ? "OpenNI2 does not say why" : text;
}

}  // namespace declutter
