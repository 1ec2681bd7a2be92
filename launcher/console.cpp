#include "launcher/console.h"

#include <limits.h>
#include <poll.h>
#include <unistd.h>

#include "launcher/rotating_log.h"

namespace declutter::launcher {

void WriteToConsole(const std::string& text) {
  // A pipe that is ready takes as much at once.
  for (size_t done = 0; done < text.size(); done += PIPE_BUF) {
    pollfd console = {STDERR_FILENO, POLLOUT, 0};
    if (poll(&console, 1, 0) != 1 || (console.revents & POLLOUT) == 0) return;
    if (WriteAll(STDERR_FILENO, text.substr(done, PIPE_BUF)) != 0) return;
  }
}

}  // namespace declutter::launcher
