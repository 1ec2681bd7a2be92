#include "modules/runtime/shell.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "lcmtypes/channels.h"
#include "modules/runtime/config_error.h"

namespace declutter::runtime {
namespace {

using Clock = std::chrono::steady_clock;

// Larger messages are lost in the receive buffers of stock kernels.
constexpr std::size_t kMaxMessageBytes = 200'000;
// At 30 Hz the depth of two seconds: more than any chain of modules lags behind.
constexpr std::size_t kMaxKeptParts = 64;
// A lossless source keeps one frame in flight; this is for publishers that do not.
constexpr std::size_t kMaxWaiting = 1024;

// A sensor gives its next frame much earlier.
constexpr double kLongPollMs = 900;

double Milliseconds() {
  return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count();
}

std::int64_t WallClockUtime() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

void AddOnce(const Port& port, std::vector<Port>* ports) {
  const auto same = [&port](const Port& other) { return other.channel == port.channel; };
  if (std::none_of(ports->begin(), ports->end(), same)) ports->push_back(port);
}

}  // namespace

Shell::Shell(Identity identity)
    : identity_(std::move(identity)),
      journal_(identity_.name),
      inbox_(identity_.lossless, kMaxWaiting) {}

std::string Shell::Wire(const std::string& channel) {
  channels_.push_back(channel);
  const auto entry = identity_.remap.find(channel);
  return entry == identity_.remap.end() ? channel : entry->second;
}

void Shell::AddSubscription(std::vector<Port> ports, PartsHandler handler) {
  Subscription subscription{std::move(ports), {}, std::move(handler), Joiner(kMaxKeptParts)};
  for (Port& port : subscription.ports) {
    port.channel = Wire(port.channel);
    subscription.layouts.push_back(&LayoutOf(port.type));
    AddOnce(port, &inputs_);
  }
  subscriptions_.push_back(std::move(subscription));
}

std::string Shell::AddOutput(Port port) {
  port.channel = Wire(port.channel);
  AddOnce(port, &outputs_);
  return port.channel;
}

void Shell::Publish(const std::string& channel, const Bytes& message) {
  if (message.size() > kMaxMessageBytes) {
    health_.Rejected();
    Warn("size of " + channel,
         channel + ": message too large to send (" + std::to_string(message.size()) + " byte)");
    return;
  }
  if (sink_) sink_(channel, message);
  health_.Published(UtimeOf(message.data()), Milliseconds());
}

void Shell::Warn(const std::string& cause, const std::string& text) {
  health_.Complain(text);
  journal_.Write(cause, text);
}

void Shell::Fail(const std::string& text) {
  failed_ = true;
  Warn(text, text);
}

void Shell::SetTrouble(const std::string& text) {
  health_.SetTrouble(text);
  const std::string line = text.empty() ? "all is well again" : text;
  journal_.Write(line, line);
}

void Shell::Reject(const std::string& channel, const std::string& why) {
  health_.Rejected();
  Warn("rejected " + channel, channel + ": rejected: " + why);
}

void Shell::Skip(std::int64_t num_frames) {
  if (num_frames == 0) return;
  health_.Skipped(num_frames);
  if (lossless()) Fail("lost a frame in a lossless run: too many wait");
}

void Shell::ExpectOnly(std::map<std::string, std::set<std::int64_t>> utimes) {
  expected_ = std::move(utimes);
}

void Shell::Receive(const std::string& channel, const std::uint8_t* data,
                    std::size_t size) noexcept {
  try {
    for (std::size_t i = 0; i < subscriptions_.size(); ++i) {
      const std::vector<Port>& ports = subscriptions_[i].ports;
      for (std::size_t port = 0; port < ports.size(); ++port) {
        if (ports[port].channel == channel) Accept(i, port, data, size);
      }
    }
  } catch (const std::exception& error) {
    Reject(channel, error.what());
  }
}

void Shell::Accept(std::size_t index, std::size_t port, const std::uint8_t* data,
                   std::size_t size) {
  Subscription& subscription = subscriptions_[index];
  subscription.layouts[port]->Locate(data, size);
  const std::int64_t utime = UtimeOf(data);
  health_.Arrived(utime, Milliseconds());
  Part part = std::make_shared<const Bytes>(data, data + size);
  if (subscription.ports.size() == 1) {
    if (!inbox_.Put({index, utime, {std::move(part)}})) Skip(1);
    return;
  }
  if (expected_ && expected_->at(subscription.ports[1 - port].channel).count(utime) == 0) {
    ++num_left_out_;
    return;
  }
  const std::int64_t num_unpaired = subscription.joiner.num_unpaired();
  const auto side = port == 0 ? Joiner::Side::kA : Joiner::Side::kB;
  std::optional<Parts> pair = subscription.joiner.Put(side, utime, std::move(part));
  // At the sensor's rate a part without a partner is a frame that another module skipped.
  if (lossless()) Skip(subscription.joiner.num_unpaired() - num_unpaired);
  if (pair && !inbox_.Put({index, utime, std::move(*pair)})) Skip(1);
}

void Shell::Handle(const Delivery& delivery) {
  const Subscription& subscription = subscriptions_[delivery.subscription];
  health_.Took();
  const double start_ms = Milliseconds();
  try {
    subscription.handler(delivery.parts);
    const double now_ms = Milliseconds();
    health_.Handled(delivery.utime, now_ms - start_ms);
    if (delivery.subscription + 1 == subscriptions_.size()) EndFrame(delivery.utime, now_ms);
  } catch (const ConfigError&) {
    throw;
  } catch (const std::runtime_error& error) {
    Reject(subscription.ports.back().channel, error.what());
  }
  health_.Done();
}

void Shell::EndFrame(std::int64_t utime, double now_ms) {
  health_.Ended(utime, now_ms);
  if (outputs_.empty()) health_.GaveOut(utime);
}

void Shell::Start() {
  if (start_) start_();
}

bool Shell::PollOnce(Clock::time_point* next) {
  // Waiting longer than an hour at once gains nothing, and keeps the sum within the clock's range.
  constexpr double kLongestWaitS = 3600;
  poll_since_ms_ = Milliseconds();
  const std::optional<double> wait_s = poll_();
  poll_since_ms_ = 0;
  if (!wait_s) return false;
  const std::chrono::duration<double> wait(std::clamp(*wait_s, 0.0, kLongestWaitS));
  *next = Clock::now() + std::chrono::duration_cast<Clock::duration>(wait);
  return true;
}

void Shell::Work() {
  Clock::time_point next_poll = Clock::now();
  while (true) {
    if (poll_ && !inbox_.closed() && Clock::now() >= next_poll && !PollOnce(&next_poll)) return;
    const auto deadline = poll_ ? next_poll : Clock::now() + std::chrono::hours(1);
    const std::optional<Delivery> delivery = inbox_.TakeUntil(deadline);
    if (delivery) {
      Handle(*delivery);
    } else if (inbox_.closed()) {
      return;
    }
  }
}

void Shell::HandleWaiting() {
  while (const std::optional<Delivery> delivery = inbox_.Take()) Handle(*delivery);
}

void Shell::PublishStatus(State state) {
  module_status_t status = health_.Report();
  status.utime = WallClockUtime();
  status.module = identity_.name;
  status.program = identity_.program;
  status.version = DECLUTTER_VERSION;
  status.pid = getpid();
  status.state = static_cast<std::int8_t>(state);
  const double since_ms = poll_since_ms_;
  const bool is_held = since_ms > 0 && Milliseconds() - since_ms > kLongPollMs;
  status.num_waiting = static_cast<std::int32_t>(inbox_.size()) + (is_held ? 1 : 0);
  Bytes message(static_cast<std::size_t>(status.getEncodedSize()));
  const int size = status.encode(message.data(), 0, static_cast<int>(message.size()));
  if (size < 0) throw std::logic_error("status does not encode");
  message.resize(static_cast<std::size_t>(size));
  sink_(kModuleStatus.name, message);
}

}  // namespace declutter::runtime
