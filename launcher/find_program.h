#pragma once

#include <optional>
#include <string>

namespace declutter::launcher {

// The folder of the running executable.
std::string OwnFolder();

// The path of an executable: beside ours, or in PATH.
std::optional<std::string> FindProgram(const std::string& name);

// True for a file that may be executed.
bool IsExecutable(const std::string& path);

}  // namespace declutter::launcher
