#include "launcher/run_folder.h"

#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace declutter::launcher {
namespace {

std::string RunName() {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof(text), "%Y%m%d-%H%M%S", &local);
  return std::string(text) + "-" + std::to_string(getpid());
}

void WriteFile(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error(path + " cannot be written");
}

// Another launcher may do the same at this moment: the link changes in one step.
void PointLatestTo(const std::filesystem::path& logs, const std::string& name) {
  const std::filesystem::path draft = logs / (name + ".latest");
  std::error_code ignored;  // a file system without links is no reason not to run
  std::filesystem::create_symlink(name, draft, ignored);
  std::filesystem::rename(draft, logs / "latest", ignored);
}

}  // namespace

RunFolder::RunFolder(const std::string& logs, const ResolvedGraph& graph) {
  const std::string name = RunName();
  path_ = std::filesystem::absolute(logs) / name;
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error) {
    throw std::runtime_error(path_ + ": " + error.message() +
                             "; --log_dir names another folder for logs");
  }
  WriteGraph(graph.Text(), graph.Versions());
  for (const ResolvedModule& module : graph.modules) {
    WriteConfig(module.module.name(), module.config_text);
  }
  PointLatestTo(logs, name);
}

void RunFolder::WriteGraph(const std::string& text, const std::string& versions) const {
  WriteFile(path_ + "/graph.textproto", text);
  WriteFile(path_ + "/versions.txt", versions);
}

std::string RunFolder::WriteConfig(const std::string& process, const std::string& text) const {
  WriteFile(ConfigPath(process), text);
  return ConfigPath(process);
}

std::string RunFolder::ConfigPath(const std::string& module) const {
  return path_ + "/" + module + ".textproto";
}

std::string RunFolder::LogPath(const std::string& process) const {
  return path_ + "/" + process + ".log";
}

}  // namespace declutter::launcher
