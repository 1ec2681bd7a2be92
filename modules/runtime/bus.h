#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lcmtypes/channels.h"

// Placeholder of the interface that module programs are written against.
namespace declutter::runtime {

template <typename Message>
class Publisher {
 public:
  void Publish(const Message& message) const;
};

class Bus {
 public:
  // handler runs on the worker thread. What it throws as std::runtime_error counts the message as
  // rejected; std::logic_error is our own bug and ends the process with 1.
  template <typename Message>
  void Subscribe(const Channel<Message>& channel, std::function<void(const Message&)> handler);

  // handler gets pairs with the same utime; what waits for its partner is bounded.
  template <typename A, typename B>
  void SubscribeJoined(const Channel<A>& a, const Channel<B>& b,
                       std::function<void(const A&, const B&)> handler);

  template <typename Message>
  Publisher<Message> Advertise(const Channel<Message>& channel);

  // For sources: poll runs on the worker thread and returns the seconds until it wants to be called
  // again (0: at once; messages that arrived are handled in between), or nullopt when the source is
  // finished and the process should end.
  void Poll(std::function<std::optional<double>()> poll);

  // True in a run over recordings, where no frame may be skipped.
  bool lossless() const;

  // One line on stderr, at most one a second per cause, `module: text`; shown in the status too.
  void Warn(const std::string& cause, const std::string& text);

  // The process goes on but will end with exit code 1.
  void Fail(const std::string& text);
};

}  // namespace declutter::runtime
