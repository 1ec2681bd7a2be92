#include "modules/kinect_source/openni/openni_text.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

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

std::string ModesText(const openni::SensorInfo& stream) {
  std::map<std::pair<int, int>, std::set<int>, std::greater<>> rates;  // of each size
  const openni::Array<openni::VideoMode>& modes = stream.getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    if (!IsReadable(modes[i])) continue;
    rates[{modes[i].getResolutionX(), modes[i].getResolutionY()}].insert(modes[i].getFps());
  }
  std::string text;
  for (const auto& [size, of_size] : rates) {
    text += (text.empty() ? "" : ", ") + std::to_string(size.first) + "x" +
            std::to_string(size.second) + " at ";
    for (const int rate : of_size) {
      text += (rate == *of_size.begin() ? "" : " or ") + std::to_string(rate);
    }
    text += " Hz";
  }
  return text.empty() ? "none that can be read" : text;
}

bool IsReadable(const openni::VideoMode& mode) {
  const openni::PixelFormat format = mode.getPixelFormat();
  return format == openni::PIXEL_FORMAT_DEPTH_1_MM || format == openni::PIXEL_FORMAT_DEPTH_100_UM ||
         format == openni::PIXEL_FORMAT_RGB888;
}

}  // namespace declutter
