#include "launcher/url_claim.h"

#include <stddef.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string>

#include "modules/runtime/config_error.h"

namespace declutter::launcher {
namespace {

// What two graphs must not share: "239.255.76.67:7667" of "udpm://239.255.76.67:7667?ttl=0".
std::string PlaceOf(const std::string& url) {
  const size_t begin = url.find("//");
  const std::string place =
      begin == std::string::npos ? url : url.substr(begin + 2, url.find('?') - begin - 2);
  return place.empty() ? "239.255.76.67:7667" : place;
}

// The process that listens at the other end; 0 when there is none.
pid_t Listener(const sockaddr_un& address, socklen_t size) {
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ucred peer = {};
  socklen_t peer_size = sizeof(peer);
  if (connect(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0) {
    getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &peer_size);
  }
  close(fd);
  return peer.pid;
}

}  // namespace

UrlClaim::UrlClaim(const std::string& url) : fd_(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  if (fd_ < 0) throw std::runtime_error(std::string("socket: ") + strerror(errno));
  // A name that begins with 0 is no file: it is gone with its process, and each network has its
  // own.
  const std::string name = "declutter " + PlaceOf(url);
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  const size_t length = std::min(name.size(), sizeof(address.sun_path) - 1);
  memcpy(address.sun_path + 1, name.data(), length);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  if (bind(fd_, reinterpret_cast<const sockaddr*>(&address), size) == 0 && listen(fd_, 4) == 0) {
    return;
  }
  const int fault = errno;
  close(fd_);
  if (fault != EADDRINUSE) throw std::runtime_error(url + ": " + strerror(fault));
  throw runtime::ConfigError(url + ": the launcher with process number " +
                             std::to_string(Listener(address, size)) + " runs a graph there");
}

UrlClaim::~UrlClaim() { close(fd_); }

}  // namespace declutter::launcher
