#pragma once

#include <stdexcept>

namespace declutter::runtime {

// The configuration or the command line cannot be used: the process ends with 2 and is not started
// again.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// what() holds one line `file:line:column: message` for each fault.
class ConfigFileError : public ConfigError {
 public:
  using ConfigError::ConfigError;
};

}  // namespace declutter::runtime
