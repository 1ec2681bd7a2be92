#include "modules/kinect_source/file_listing.h"

#include <algorithm>
#include <system_error>

namespace declutter {

namespace fs = std::filesystem;

std::vector<fs::path> ListFiles(const fs::path& path, const std::string& extension) {
  std::vector<fs::path> files;
  std::error_code error;
  if (fs::is_regular_file(path, error)) {
    if (path.extension() == extension) files.push_back(path);
    return files;
  }
  fs::directory_iterator entry(path, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().extension() == extension && entry->is_regular_file(ignored)) {
      files.push_back(entry->path());
    }
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
  return files;
}

fs::path IntrinsicsPath(const fs::path& input, const std::string& intrinsics_file) {
  if (!intrinsics_file.empty()) return intrinsics_file;
  return (fs::is_directory(input) ? input : input.parent_path()) / "intrinsics.json";
}

}  // namespace declutter
