#pragma once

#include <memory>
#include <string>

#include "modules/runtime/part.h"
#include "modules/runtime/shell.h"

struct _lcm_t;

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
  // until a signal for the end arrives on signal_fd; then hands over what is still in the socket
  // and stops the shell. Returns when end_fd becomes readable.
  void Serve(int signal_fd, int end_fd);

 private:
  bool Receive();
  void Drain();

  Shell* const shell_;
  _lcm_t* lcm_ = nullptr;
};

}  // namespace declutter::runtime
