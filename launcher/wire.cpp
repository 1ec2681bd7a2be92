#include "launcher/wire.h"

#include <stdexcept>
#include <utility>

#include "modules/runtime/message_layout.h"

namespace declutter::launcher {
namespace {

constexpr int kQueueCapacity = 1024;  // LCM's own, 30, drops the newest

}  // namespace

Wire::Wire(const std::string& url) : lcm_(lcm_create(url.c_str())) {
  if (lcm_ == nullptr) throw std::runtime_error(url + " cannot be opened");
}

Wire::~Wire() { lcm_destroy(lcm_); }

void Wire::Subscribe(const std::string& pattern) {
  lcm_subscription_t* subscription = lcm_subscribe(lcm_, pattern.c_str(), OnMessage, this);
  // LCM joins the network only now.
  if (subscription == nullptr || fd() < 0) throw std::runtime_error("the network cannot be joined");
  lcm_subscription_set_queue_capacity(subscription, kQueueCapacity);
}

std::vector<Message> Wire::Receive() {
  while (lcm_handle_timeout(lcm_, 0) > 0) {
  }
  return std::exchange(received_, {});
}

void Wire::Publish(const Message& message) {
  lcm_publish(lcm_, message.channel.c_str(), message.bytes.data(),
              static_cast<unsigned>(message.bytes.size()));
}

void Wire::OnMessage(const lcm_recv_buf_t* buffer, const char* channel, void* self) {
  const auto* data = static_cast<const uint8_t*>(buffer->data);
  static_cast<Wire*>(self)->received_.push_back({channel, {data, data + buffer->data_size}});
}

std::optional<module_status_t> DecodeStatus(const Message& message) {
  if (message.channel != kModuleStatus.name) return std::nullopt;
  const size_t size = message.bytes.size();
  try {
    runtime::LayoutOf(module_status_t::getTypeName()).Locate(message.bytes.data(), size);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
  module_status_t status;
  if (status.decode(message.bytes.data(), 0, static_cast<int>(size)) < 0) return std::nullopt;
  return status;
}

}  // namespace declutter::launcher
