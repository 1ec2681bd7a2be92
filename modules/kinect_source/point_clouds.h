#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/kinect_source/recording_entry.h"

namespace declutter {

// The frames of a .pcd file or of a folder of them in byte order, 1/30 s apart; empty when there is
// none. Points are in camera frame C.
//
// The camera of an organised cloud is recovered from its points. A cloud that is not organised, or
// has no measurement, takes it from `intrinsics_file` or, when that is empty, from intrinsics.json
// beside it, and is unreadable without. Throws std::invalid_argument when a given intrinsics file
// cannot be used.
std::vector<RecordingEntry> ListPointClouds(const std::filesystem::path& input,
                                            const std::string& intrinsics_file);

}  // namespace declutter
