#pragma once

#include <string>

#include "launcher/control.pb.h"

namespace declutter::launcher {

// For people: a line for each process under a head, then what each last complained of, then where
// the graph runs.
std::string StatusTable(const ControlReply& reply);

}  // namespace declutter::launcher
