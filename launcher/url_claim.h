#pragma once

#include <string>

namespace declutter::launcher {

// The right to run a graph over a url, of one launcher at a time in a network, while it lives.
class UrlClaim {
 public:
  // Throws runtime::ConfigError with the number of the process that has it.
  explicit UrlClaim(const std::string& url);
  ~UrlClaim();
  UrlClaim(const UrlClaim&) = delete;
  UrlClaim& operator=(const UrlClaim&) = delete;

 private:
  int fd_;
};

}  // namespace declutter::launcher
