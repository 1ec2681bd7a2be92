#include "launcher/network.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <lcm/lcm.h>
#include <net/if.h>
#include <net/route.h>
#include <sched.h>
#include <signal.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <vector>

namespace declutter::launcher {
namespace {

constexpr const char* kMulticastAddress = "239.255.76.67";
constexpr int kFirstPort = 17000;  // below the kernel's range for outgoing connections
constexpr int kNumPorts = 15000;
constexpr int kMaxReceiveBuffer = 4 << 20;
constexpr size_t kTestSize = 150'000;
constexpr int kMaxAttempts = 12;  // a busy machine may lose some of its messages
constexpr const char* kTestChannel = "LCM_SELF_TEST";

class Socket {
 public:
  Socket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    if (fd_ < 0) throw std::runtime_error(std::string("socket: ") + strerror(errno));
  }
  ~Socket() { close(fd_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int fd() const { return fd_; }

 private:
  int fd_;
};

sockaddr_in Address(const char* address, int port) {
  sockaddr_in result = {};
  result.sin_family = AF_INET;
  result.sin_port = htons(static_cast<uint16_t>(port));
  inet_pton(AF_INET, address, &result.sin_addr);
  return result;
}

// LCM shares its port between sockets; binding without sharing fails while any other is on it.
bool IsFree(int port) {
  const Socket socket;
  const sockaddr_in address = Address("0.0.0.0", port);
  return bind(socket.fd(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
}

void CountTestMessage(const lcm_recv_buf_t* buffer, const char*, void* num_received) {
  if (buffer->data_size == kTestSize) ++*static_cast<int*>(num_received);
}

bool PassesSelfTest(const std::string& url) {
  lcm_t* lcm = lcm_create(url.c_str());
  if (lcm == nullptr) return false;
  int num_received = 0;
  const std::vector<uint8_t> message(kTestSize);
  lcm_subscribe(lcm, kTestChannel, CountTestMessage, &num_received);
  for (int attempt = 0; attempt < kMaxAttempts && num_received == 0; ++attempt) {
    lcm_publish(lcm, kTestChannel, message.data(), static_cast<unsigned>(message.size()));
    while (num_received == 0 && lcm_handle_timeout(lcm, 300) > 0) {
    }
  }
  lcm_destroy(lcm);
  return num_received > 0;
}

// What a child that is silent says to it; false when it throws.
bool Succeeds(const std::function<bool()>& attempt) {
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error(std::string("fork: ") + strerror(errno));
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // it died before the line above
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    try {
      _exit(attempt() ? 0 : 1);
    } catch (const std::exception&) {
      _exit(1);
    }
  }
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void Unshare() {
  const uid_t uid = getuid();
  const gid_t gid = getgid();
  if (unshare(CLONE_NEWNET) == 0) return;
  if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
    throw std::runtime_error(std::string("no network namespace: ") + strerror(errno));
  }
  // We stay who we are: files we write keep their owner.
  std::ofstream("/proc/self/setgroups") << "deny";
  std::ofstream("/proc/self/uid_map") << uid << " " << uid << " 1";
  std::ofstream("/proc/self/gid_map") << gid << " " << gid << " 1";
}

void BringLoopbackUp() {
  const Socket socket;
  ifreq interface = {};
  strncpy(interface.ifr_name, "lo", IFNAMSIZ - 1);
  interface.ifr_flags = IFF_UP | IFF_RUNNING | IFF_LOOPBACK;
  if (ioctl(socket.fd(), SIOCSIFFLAGS, &interface) != 0) {
    throw std::runtime_error(std::string("loopback: ") + strerror(errno));
  }
  char device[] = "lo";
  const sockaddr_in destination = Address("239.0.0.0", 0);
  const sockaddr_in mask = Address("255.0.0.0", 0);
  rtentry route = {};
  memcpy(&route.rt_dst, &destination, sizeof(destination));
  memcpy(&route.rt_genmask, &mask, sizeof(mask));
  route.rt_flags = RTF_UP;
  route.rt_dev = device;
  if (ioctl(socket.fd(), SIOCADDRT, &route) != 0 && errno != EEXIST) {
    throw std::runtime_error(std::string("multicast route: ") + strerror(errno));
  }
}

}  // namespace

std::string ChooseUrl(int num_refused) {
  int port = 0;
  for (int i = 0; i < kNumPorts && port == 0; ++i) {
    const int candidate = kFirstPort + (getpid() + i) % kNumPorts;
    if (IsFree(candidate) && num_refused-- == 0) port = candidate;
  }
  if (port == 0) throw std::runtime_error("no free port for messages");
  return WithReceiveBuffer(std::string("udpm://") + kMulticastAddress + ":" + std::to_string(port) +
                           "?ttl=0");
}

std::string WithReceiveBuffer(const std::string& url) {
  if (url.rfind("udpm://", 0) != 0 || url.find("recv_buf_size=") != std::string::npos) return url;
  int max_buffer = kMaxReceiveBuffer;
  if (std::ifstream file("/proc/sys/net/core/rmem_max"); !(file >> max_buffer)) {
    max_buffer = kMaxReceiveBuffer;
  }
  return url + (url.find('?') == std::string::npos ? "?" : "&") +
         "recv_buf_size=" + std::to_string(std::min(max_buffer, kMaxReceiveBuffer));
}

// In a child, as LCM starts threads, which bar the way into a user namespace, and prints.
bool CarriesMessages(const std::string& url) {
  return Succeeds([&url] { return PassesSelfTest(url); });
}

bool CanIsolate() {
  return Succeeds([] {
    Isolate();
    return true;
  });
}

void Isolate() {
  Unshare();
  BringLoopbackUp();
}

bool EnsureMulticast(const std::string& url) {
  if (CarriesMessages(url)) return false;
  try {
    Isolate();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(url +
                             " carries no messages of 150 KB here, and a network of our own " +
                             "cannot be made (" + error.what() +
                             "); as root: ip link set lo up; ip route add 239.0.0.0/8 dev lo");
  }
  if (!CarriesMessages(url)) throw std::runtime_error(url + " carries no messages of 150 KB");
  return true;
}

}  // namespace declutter::launcher
