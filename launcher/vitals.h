#pragma once

#include <sys/types.h>

#include "launcher/control.pb.h"
#include "lcmtypes/channels.h"

namespace declutter::launcher {

// How one process does, from what it says and from what the kernel says of it.
class Vitals {
 public:
  // A status that it has published.
  void Hear(const module_status_t& status);

  // To be called often; pid: -1 while there is none. Looks about once a second.
  void Look(pid_t pid, double now_s);

  // The fields that are known here.
  ProcessStatus Report() const;

 private:
  module_status_t status_ = {};
  double rate_hz_ = 0.0;
  pid_t pid_ = -1;
  double look_s_ = -1.0;
  double cpu_s_ = 0.0;  // used until then
  double load_ = 0.0;
  double memory_mb_ = 0.0;
};

}  // namespace declutter::launcher
