#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/kinect_source/recording_entry.h"

namespace declutter {

// The frames of 16-bit depth PNGs in the convention of the TUM RGB-D data sets: those that
// depth.txt lists, else depth/*.png, else *.png; `input` may also be one PNG. Names with a decimal
// point are times in seconds; without them frames are 1/30 s apart in byte order of their names.
// Colour comes from rgb.txt or rgb/*.png: nearest in time, at most 20 ms away, or of the same name.
//
// The camera is in `intrinsics_file` or, when that is empty, in intrinsics.json of the folder; its
// depth_scale_m is 1/5000 m when not given. Empty when there is no PNG; throws
// std::invalid_argument when the camera is missing or a list cannot be understood.
std::vector<RecordingEntry> ListPngSequence(const std::filesystem::path& input,
                                            const std::string& intrinsics_file);

}  // namespace declutter
