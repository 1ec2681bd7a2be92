#pragma once

#include <lcm/lcm.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lcmtypes/channels.h"

namespace declutter::launcher {

// A message as it is on the network.
struct Message {
  std::string channel;
  std::vector<uint8_t> bytes;
};

// The launcher's place on the network of a graph.
class Wire {
 public:
  // Throws std::runtime_error when the network of url cannot be joined.
  explicit Wire(const std::string& url);
  ~Wire();
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  // Throws std::runtime_error when the network does not work.
  // pattern: a regular expression, of all channels that are to be heard; to be called once.
  void Subscribe(const std::string& pattern);

  // Readable when something has arrived.
  int fd() const { return lcm_get_fileno(lcm_); }

  // What has arrived since the last call.
  std::vector<Message> Receive();

  void Publish(const Message& message);

 private:
  static void OnMessage(const lcm_recv_buf_t* buffer, const char* channel, void* self);

  lcm_t* lcm_;
  std::vector<Message> received_;  // only copied inside LCM's C frames
};

// Nothing when the message is no status, whatever else it may be.
std::optional<module_status_t> DecodeStatus(const Message& message);

template <typename Type>
Message Encode(const Channel<Type>& channel, const Type& value) {
  Message message{channel.name, std::vector<uint8_t>(static_cast<size_t>(value.getEncodedSize()))};
  value.encode(message.bytes.data(), 0, static_cast<int>(message.bytes.size()));
  return message;
}

}  // namespace declutter::launcher
