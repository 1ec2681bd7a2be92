#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/kinect_source/recording_entry.h"

namespace declutter {

// The scene folders at or below `input`: folders with a scene.json or a file `depth_file`, in the
// byte order of their paths below input. A frame is named after that path with _ for /, or after
// the folder itself when input is one. Links to folders are followed. Empty when there is none.
//
// A scene is unreadable when its scene.json or its depth image is missing or cannot be used; a
// folder that cannot be listed is an unreadable scene too. rgb.png is optional.
std::vector<RecordingEntry> ListSceneFolders(const std::filesystem::path& input,
                                             const std::string& depth_file);

}  // namespace declutter
