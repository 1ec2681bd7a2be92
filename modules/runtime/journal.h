#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace declutter::runtime {

// Lets one line a second per cause through.
class LineLimiter {
 public:
  // How many lines of this cause were held back since the last one that was let through; nullopt to
  // hold this one back, too. now_s must not decrease.
  std::optional<int> Admit(const std::string& cause, double now_s);

 private:
  struct Cause {
    double last_s;
    int num_held_back;
  };

  std::map<std::string, Cause> causes_;
};

// Writes lines for people, `name: text`, to stderr. May be used from all threads.
class Journal {
 public:
  explicit Journal(std::string name) : name_(std::move(name)) {}

  void Write(const std::string& cause, const std::string& text);

  const std::string& name() const { return name_; }

 private:
  const std::string name_;
  std::mutex mutex_;
  LineLimiter limiter_;
};

}  // namespace declutter::runtime
