#include "modules/object_exporter/picture_names.h"

#include <algorithm>

namespace declutter {
namespace {

// File systems allow 255 bytes; ".overlay.png" and a number come after the name.
constexpr size_t kMaxNameBytes = 200;

// The name of a frame as a file name: it comes from a message and may be anything.
std::string AsFileName(const std::string& frame) {
  std::string name = frame.substr(0, kMaxNameBytes);
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return c == '/' || c == '\\' || c < 0x20 || c == 0x7F; }, '_');
  return name.empty() ? "frame" : name;
}

}  // namespace

// Frames may share a name, or have names that differ only in what a file name cannot hold.
std::string PictureNames::NewFor(const std::string& frame) {
  const std::string name = AsFileName(frame);
  std::string candidate = name;
  for (int i = 2; !given_.insert(candidate).second; ++i) {
    candidate = name + "-" + std::to_string(i);
  }
  return candidate;
}

}  // namespace declutter
