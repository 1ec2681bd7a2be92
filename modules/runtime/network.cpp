#include "modules/runtime/network.h"

#include <lcm/lcm.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>

namespace declutter::runtime {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kStatusPeriod(1000);
constexpr int kSettleMs = 50;
// LCM's queue drops the newest message when it is full; ours (Inbox) decides better what to drop.
constexpr int kQueueCapacity = 1024;

// An exception must not cross LCM's C frames: Shell::Receive does not throw.
void OnMessage(const lcm_recv_buf_t* buffer, const char* channel, void* shell) {
  static_cast<Shell*>(shell)->Receive(channel, static_cast<const std::uint8_t*>(buffer->data),
                                      buffer->data_size);
}

void OnNothing(const lcm_recv_buf_t*, const char*, void*) {}

std::runtime_error NoNetwork() {
  const char* url = std::getenv("LCM_DEFAULT_URL");
  const std::string where = url != nullptr ? url : "udpm://239.255.76.67:7667?ttl=0";
  return std::runtime_error("no LCM network at " + where +
                            "; without a multicast route, "
                            "`ip link set lo up; ip route add 239.0.0.0/8 dev lo` gives one");
}

int MillisecondsUntil(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return left > 0 ? static_cast<int>(left) : 0;
}

}  // namespace

Network::Network(Shell* shell) : shell_(shell), lcm_(lcm_create(nullptr)) {
  if (lcm_ == nullptr) throw NoNetwork();
  // LCM proves that its messages arrive only when the first subscription is made. A module without
  // inputs would never learn that it talks to nobody.
  lcm_subscription_t* probe = lcm_subscribe(lcm_, "DECLUTTER_PROBE", OnNothing, nullptr);
  if (probe == nullptr || lcm_get_fileno(lcm_) < 0 || lcm_handle_timeout(lcm_, 0) < 0) {
    lcm_destroy(lcm_);
    throw NoNetwork();
  }
  lcm_unsubscribe(lcm_, probe);
}

Network::~Network() { lcm_destroy(lcm_); }

void Network::Subscribe() {
  for (const Port& port : shell_->inputs()) {
    lcm_subscription_t* subscription = lcm_subscribe(lcm_, port.channel.c_str(), OnMessage, shell_);
    if (subscription == nullptr) throw std::runtime_error("cannot subscribe " + port.channel);
    lcm_subscription_set_queue_capacity(subscription, kQueueCapacity);
  }
}

void Network::Publish(const std::string& channel, const Bytes& message) {
  const auto size = static_cast<unsigned int>(message.size());
  if (lcm_publish(lcm_, channel.c_str(), message.data(), size) != 0) {
    shell_->Warn("send " + channel,
                 channel + ": cannot be sent (" + std::to_string(size) + " byte)");
  }
}

bool Network::Receive() {
  if (lcm_handle_timeout(lcm_, 0) >= 0) return true;
  shell_->Fail("lost the LCM network");
  return false;
}

// Packets pass through a thread of LCM's own: an empty queue is final only after a moment.
void Network::Drain(std::chrono::milliseconds limit) {
  const Clock::time_point deadline = Clock::now() + limit;
  while (Clock::now() < deadline && lcm_handle_timeout(lcm_, kSettleMs) > 0) {
  }
}

void Network::ReadRelease(pollfd* release) {
  char buffer[64];
  const ssize_t num_read = read(release->fd, buffer, sizeof(buffer));
  release_.append(buffer, num_read > 0 ? static_cast<std::size_t>(num_read) : 0);
  if (num_read > 0 && release_.find('\n') == std::string::npos) return;
  release->fd = -1;
  // Who holds us is gone without a word.
  if (num_read <= 0) return shell_->Stop();
  // What arrived before belongs to what is held.
  Drain(std::chrono::milliseconds(kSettleMs));
  shell_->Release(std::strtoll(release_.c_str(), nullptr, 10));
}

void Network::Serve(int signal_fd, int end_fd, int release_fd) {
  pollfd fds[] = {{end_fd, POLLIN, 0},
                  {signal_fd, POLLIN, 0},
                  {lcm_get_fileno(lcm_), POLLIN, 0},
                  {release_fd, POLLIN, 0}};
  Clock::time_point next_status = Clock::now();
  bool stopping = false;
  while (true) {
    if (Clock::now() >= next_status) {
      shell_->PublishStatus(Shell::State::kRunning);
      next_status += kStatusPeriod;
    }
    const nfds_t num_fds = stopping ? 1 : 4;
    if (poll(fds, num_fds, MillisecondsUntil(next_status)) <= 0) continue;
    if (fds[0].revents != 0) return;
    if (stopping) continue;
    if (fds[3].revents != 0) ReadRelease(&fds[3]);
    stopping = (fds[2].revents != 0 && !Receive()) || fds[1].revents != 0;
    if (!stopping) continue;
    if (shell_->lossless()) Drain(std::chrono::seconds(1));
    shell_->Stop();
  }
}

}  // namespace declutter::runtime
