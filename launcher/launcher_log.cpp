#include "launcher/launcher_log.h"

#include <ctime>

#include "launcher/console.h"

namespace declutter::launcher {
namespace {

constexpr int64_t kMaxLog = 10 << 20;  // [byte] of each of two files

std::string Now() {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S", &local);
  return text;
}

}  // namespace

LauncherLog::LauncherLog(const std::string& path) : log_(path, kMaxLog) {}

void LauncherLog::Say(const std::string& text) {
  WriteToConsole("launcher: " + text + "\n");
  log_.Write(Now() + " " + text + "\n");
}

}  // namespace declutter::launcher
