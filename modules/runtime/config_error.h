#pragma once

#include <stdexcept>

namespace declutter::runtime {

// The configuration or the command line cannot be used: the process ends with 2 and is not started
// again. what() is the whole line for people.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace declutter::runtime
