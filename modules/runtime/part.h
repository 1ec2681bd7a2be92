#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace declutter::runtime {

using Bytes = std::vector<std::uint8_t>;

// An encoded message whose layout was checked. Shared, because a joined frame keeps its parts for
// the case that one of them is sent again.
using Part = std::shared_ptr<const Bytes>;

// The messages of one frame, in the order of the channels of the subscription.
using Parts = std::vector<Part>;
using PartsHandler = std::function<void(const Parts&)>;

// A channel and the name of the message type that it carries.
struct Port {
  std::string channel;
  std::string type;
};

}  // namespace declutter::runtime
