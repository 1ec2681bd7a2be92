#include "launcher/find_program.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace declutter::launcher {

std::string OwnFolder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

std::optional<std::string> FindProgram(const std::string& name) {
  const char* search_path = std::getenv("PATH");
  std::istringstream folders(OwnFolder() + ":" + (search_path == nullptr ? "" : search_path));
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path path = std::filesystem::absolute(folder) / name;
    if (IsExecutable(path)) return path;
  }
  return std::nullopt;
}

bool IsExecutable(const std::string& path) {
  std::error_code ignored;  // what cannot be looked at cannot be executed
  return std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

}  // namespace declutter::launcher
