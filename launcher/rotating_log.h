#pragma once

#include <cstdint>
#include <string>

namespace declutter::launcher {

// A file that text is appended to. When it is full it becomes PATH.1, in place of the one before,
// and a new one begins.
class RotatingLog {
 public:
  // Throws std::runtime_error when it cannot be opened.
  RotatingLog(const std::string& path, int64_t max_bytes);
  ~RotatingLog();
  RotatingLog(const RotatingLog&) = delete;
  RotatingLog& operator=(const RotatingLog&) = delete;

  // What the disk does not take is lost: then the errno of that, else 0.
  int Write(const std::string& text);

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int64_t max_bytes_;
  int fd_;
  int64_t num_bytes_;
};

// Writes all that is taken; the errno of what is not, else 0.
int WriteAll(int fd, const std::string& text);

}  // namespace declutter::launcher
