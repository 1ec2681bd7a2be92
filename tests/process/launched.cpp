#include "tests/process/launched.h"

#include <fcntl.h>
#include <lcm/eventlog.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace declutter {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = fs::temp_directory_path() / "process_test_XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() { fs::remove_all(path_); }

std::string TemporaryFolder::Write(const std::string& name, const std::string& text) const {
  fs::remove(Path(name));  // to empty a file makes some disks wait, to make another does not
  std::ofstream(Path(name)) << text;
  return Path(name);
}

Launched::Launched(std::vector<std::string> command, const TemporaryFolder& folder,
                   const std::function<void()>& before)
    : folder_(folder) {
  std::vector<char*> argv;
  for (std::string& word : command) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
  dup2(open(folder.Path("stdout").c_str(), kFlags, 0644), STDOUT_FILENO);
  dup2(open(folder.Path("stderr").c_str(), kFlags, 0644), STDERR_FILENO);
  if (before) before();
  execv(argv[0], argv.data());
  _exit(127);
}

Launched::~Launched() {
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void Launched::Signal(int signal) const { kill(pid_, signal); }

Outcome Launched::Wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, ReadFile(folder_.Path("stdout")), ReadFile(folder_.Path("stderr"))};
}

Outcome RunLauncher(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  std::vector<std::string> command = {LAUNCHER};
  command.insert(command.end(), arguments.begin(), arguments.end());
  if (!arguments.empty() && arguments[0] == "run") {
    command.insert(command.end(), {"--log_dir", folder.Path("logs")});
  }
  return Launched(command, folder).Wait();
}

std::vector<pid_t> ProcessesWith(const std::string& word) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string number = entry.path().filename();
    if (!std::all_of(number.begin(), number.end(), ::isdigit)) continue;
    try {
      const std::string command = ReadFile(entry.path() / "cmdline");  // empty for a zombie
      if (command.find(word) != std::string::npos) found.push_back(std::stoi(number));
    } catch (const std::ios_base::failure&) {  // it has ended
    }
  }
  return found;
}

bool Eventually(const std::function<bool()>& condition, double limit_s) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit_s);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

bool IsReplaced(const std::function<pid_t()>& find, pid_t old, double limit_s) {
  return Eventually(
      [&] {
        // Between two looks it may end.
        const pid_t found = find();
        return found > 0 && found != old;
      },
      limit_s);
}

std::vector<std::string> MessagesOf(const std::string& channel, const std::string& log) {
  std::vector<std::string> messages;
  lcm_eventlog_t* events = lcm_eventlog_create(log.c_str(), "r");
  if (events == nullptr) return messages;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(events)) {
    if (event->channel == channel) {
      messages.emplace_back(static_cast<const char*>(event->data),
                            static_cast<size_t>(event->datalen));
    }
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(events);
  return messages;
}

std::vector<int64_t> UtimesOf(const std::string& channel, const std::string& log) {
  constexpr size_t kFingerprint = 8, kUtime = 8;  // [byte], big-endian
  std::vector<int64_t> utimes;
  for (const std::string& message : MessagesOf(channel, log)) {
    if (message.size() < kFingerprint + kUtime) continue;
    uint64_t utime = 0;
    for (size_t i = 0; i < kUtime; ++i) {
      utime = utime << 8 | static_cast<uint8_t>(message[kFingerprint + i]);
    }
    utimes.push_back(static_cast<int64_t>(utime));
  }
  return utimes;
}

std::string ReadFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace declutter
