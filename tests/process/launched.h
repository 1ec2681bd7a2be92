#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace declutter {

// A folder that is gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string Path(const std::string& name) const { return path_ + "/" + name; }
  std::string Write(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

// What a program that has ended leaves.
struct Outcome {
  int code = 0;  // of exit(); 128 + signal when one ended it
  std::string out;
  std::string err;
};

// A program under test.
class Launched {
 public:
  // before runs in the child ahead of the program. Output goes to files in folder.
  Launched(std::vector<std::string> command, const TemporaryFolder& folder,
           const std::function<void()>& before = {});
  ~Launched();  // kills it if it still runs
  Launched(const Launched&) = delete;
  Launched& operator=(const Launched&) = delete;

  pid_t pid() const { return pid_; }
  void Signal(int signal) const;
  Outcome Wait();

 private:
  const TemporaryFolder& folder_;
  pid_t pid_;
};

// Runs the launcher with these arguments to its end.
Outcome RunLauncher(const std::vector<std::string>& arguments, const TemporaryFolder& folder);

// Process numbers of the programs whose command line holds word.
std::vector<pid_t> ProcessesWith(const std::string& word);

// True when condition becomes true within limit_s.
bool Eventually(const std::function<bool()>& condition, double limit_s = 10.0);

// True as soon as find, which gives 0 where there is none, gives another process than the old one.
bool IsReplaced(const std::function<pid_t()>& find, pid_t old, double limit_s = 10.0);

// The bytes of the messages on a channel, in the order of the LCM log.
std::vector<std::string> MessagesOf(const std::string& channel, const std::string& log);

// The times that the messages on a channel begin with, in the order of the LCM log.
std::vector<int64_t> UtimesOf(const std::string& channel, const std::string& log);

std::string ReadFile(const std::string& path);

}  // namespace declutter
