#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace declutter {

// Files of a folder whose names end with `extension` (".png"), in byte order. A path that is such a
// file itself is returned alone. Empty when there are none or no folder.
std::vector<std::filesystem::path> ListFiles(const std::filesystem::path& path,
                                             const std::string& extension);

// The file with the intrinsics of a recording: intrinsics_file when given, else intrinsics.json
// beside the files of `input`, a folder or a file; it need not exist.
std::filesystem::path IntrinsicsPath(const std::filesystem::path& input,
                                     const std::string& intrinsics_file);

}  // namespace declutter
