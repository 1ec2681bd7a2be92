#include "launcher/rotating_log.h"

#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>

namespace declutter::launcher {
namespace {

int Open(const std::string& path) {
  return open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
}

int64_t SizeOf(int fd) {
  struct stat state = {};
  fstat(fd, &state);
  return state.st_size;
}

}  // namespace

RotatingLog::RotatingLog(const std::string& path, int64_t max_bytes)
    : path_(path), max_bytes_(max_bytes), fd_(Open(path)) {
  if (fd_ < 0) throw std::runtime_error(path + ": " + strerror(errno));
  num_bytes_ = SizeOf(fd_);
}

RotatingLog::~RotatingLog() { close(fd_); }

int RotatingLog::Write(const std::string& text) {
  const auto size = static_cast<int64_t>(text.size());
  if (num_bytes_ > 0 && num_bytes_ + size > max_bytes_) {
    const bool is_moved = std::rename(path_.c_str(), (path_ + ".1").c_str()) == 0;
    const int next = is_moved ? Open(path_) : -1;
    if (next >= 0) {
      close(fd_);
      fd_ = next;
      num_bytes_ = 0;
    }
  }
  const int fault = WriteAll(fd_, text);
  if (fault == 0) num_bytes_ += size;
  return fault;
}

int WriteAll(int fd, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t written = write(fd, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    done += static_cast<size_t>(written);
  }
  return 0;
}

}  // namespace declutter::launcher
