#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "modules/runtime/part.h"
#include "modules/runtime/shell.h"

struct _lcm_t;
struct pollfd;

namespace declutter::runtime {

// The LCM network that a process is part of; where it is, LCM_DEFAULT_URL says. The only place that
// knows LCM.
class Network {
 public:
  // Throws std::runtime_error when there is no network, with what mends it. shell must outlive it.
  explicit Network(Shell* shell);
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  // To be called once, after the module subscribed.
  void Subscribe();

  // May be called from all threads.
  void Publish(const std::string& channel, const Bytes& message);

  // The life of the I/O thread: hands over what arrives and publishes the status once a second
  // until a signal for the end arrives on signal_fd; then stops the shell, in a lossless run after
  // handing over what is still in the socket. Returns when end_fd becomes readable. A time that
  // comes on release_fd releases the shell; -1: it holds nothing.
  void Serve(int signal_fd, int end_fd, int release_fd);

 private:
  bool Receive();
  void ReadRelease(pollfd* release);
  void Drain(std::chrono::milliseconds limit);

  Shell* const shell_;
  _lcm_t* lcm_ = nullptr;
  std::string release_;  // what has been read of the time
};

}  // namespace declutter::runtime
