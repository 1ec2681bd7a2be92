#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "launcher/control.pb.h"
#include "launcher/control_socket.h"
#include "launcher/supervisor.h"

namespace declutter::launcher {

// What users have asked a running graph to do, until it is done or cannot be done any more.
class Orders {
 public:
  // verb and module of request must be known; supervisor has handled it.
  void Add(ControlSocket::Id id, Asked::Verb verb, const std::string& module,
           const Supervisor& supervisor);

  // The answers that have become known.
  std::vector<std::pair<ControlSocket::Id, ControlReply>> Settle(const Supervisor& supervisor);

 private:
  struct Order {
    ControlSocket::Id id;
    Asked::Verb verb;
    std::string module;
    int num_swaps;  // before
  };

  std::vector<Order> orders_;
};

std::string NameOf(State state);

}  // namespace declutter::launcher
