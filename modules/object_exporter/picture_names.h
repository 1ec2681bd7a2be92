#pragma once

#include <set>
#include <string>

namespace declutter {

// File names for what is written of the frames of a run.
class PictureNames {
 public:
  // A name that was not given before, as like that of the frame as a file name can be.
  std::string NewFor(const std::string& frame);

 private:
  std::set<std::string> given_;
};

}  // namespace declutter
