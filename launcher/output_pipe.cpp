#include "launcher/output_pipe.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <utility>

namespace declutter::launcher {
namespace {

constexpr size_t kMaxLine = 64 << 10;     // [byte] longer ones are cut
constexpr size_t kMaxForward = 64 << 10;  // [byte] at a time

}  // namespace

OutputPipe::OutputPipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(strerror(errno));
  fd_ = ends[0];
  child_end_ = ends[1];
  fcntl(fd_, F_SETFL, O_NONBLOCK);
}

OutputPipe::~OutputPipe() {
  CloseChildEnd();
  if (fd_ >= 0) close(fd_);
}

void OutputPipe::CloseChildEnd() {
  if (child_end_ >= 0) close(std::exchange(child_end_, -1));
}

void OutputPipe::Forward(const std::function<void(const std::string& lines)>& take) {
  char buffer[4096];
  ssize_t num_read = 1;
  for (size_t total = 0; fd_ >= 0 && num_read > 0 && total < kMaxForward;) {
    num_read = read(fd_, buffer, sizeof(buffer));
    if (num_read < 0) break;
    total += static_cast<size_t>(num_read);
    line_.append(buffer, static_cast<size_t>(num_read));
  }
  const bool is_end = num_read == 0 || (num_read < 0 && errno != EAGAIN && errno != EINTR);
  if (is_end) close(std::exchange(fd_, -1));
  if ((is_end || line_.size() > kMaxLine) && !line_.empty() && line_.back() != '\n') line_ += '\n';
  const size_t end = line_.rfind('\n');
  if (end == std::string::npos) return;
  take(line_.substr(0, end + 1));
  line_.erase(0, end + 1);
}

}  // namespace declutter::launcher
