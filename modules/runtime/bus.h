#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lcmtypes/channels.h"
#include "modules/runtime/config_error.h"
#include "modules/runtime/part.h"

// What a module sees of its process. Channels are typed; LCM, threads, signals and log files are
// the shell's business (run.h).
namespace declutter::runtime {

class Shell;

// Handlers may be lambdas: the message type follows from the channel alone.
template <typename... Messages>
struct HandlerOf {
  using type = std::function<void(const Messages&...)>;
};
template <typename... Messages>
using Handler = typename HandlerOf<Messages...>::type;

template <typename Message>
class Publisher {
 public:
  // A message above the size limit of the wire is dropped, counted as rejected and reported.
  void Publish(const Message& message) const;

 private:
  friend class Bus;
  Publisher(Shell* shell, std::string channel) : shell_(shell), channel_(std::move(channel)) {}

  Shell* shell_;
  std::string channel_;
};

// The constructor of a module subscribes and advertises; it must not touch the outside world,
// because --describe constructs the module too. All handlers run on one thread, one at a time.
//
// A module subscribes in the order in which a frame's messages come: what its last subscription
// delivers is the end of the frame, as the status counts it.
//
// What a handler throws as std::runtime_error counts its frame as rejected; ConfigError ends the
// process with 2; anything else (std::logic_error: our own bug) ends it with 1.
class Bus {
 public:
  explicit Bus(Shell* shell) : shell_(shell) {}

  template <typename Message>
  void Subscribe(const Channel<Message>& channel, Handler<Message> handler);

  // handler gets pairs with the same utime, where b was computed from a. What waits for its partner
  // is bounded. A part that is sent again makes its pair again; an a with other content under the
  // same utime is another frame and waits for a new b.
  template <typename A, typename B>
  void SubscribeJoined(const Channel<A>& a, const Channel<B>& b, Handler<A, B> handler);

  template <typename Message>
  Publisher<Message> Advertise(const Channel<Message>& channel);

  // start is called once, when the process really runs, before the first message: here files are
  // opened and folders made.
  void OnStart(std::function<void()> start);

  // For sources: poll returns the seconds until it wants to be called again (0: at once; messages
  // that arrived are handled in between), or nullopt when the source is finished and the process
  // should end. It should not take longer than a second: the launcher ends what hangs in it.
  void Poll(std::function<std::optional<double>()> poll);

  // True in a run over recordings, where no frame may be skipped.
  bool lossless() const;

  // One line on stderr, at most one a second per cause, `module: text`; shown in the status too.
  void Warn(const std::string& cause, const std::string& text);

  // As Warn, and the process goes on but will end with exit code 1.
  void Fail(const std::string& text);

  // What is wrong until the next call, shown in every status until then; empty: nothing. A line on
  // stderr when it changes.
  void SetTrouble(const std::string& text);

  // One line on stderr about what is not wrong.
  void Note(const std::string& text);

  // For sources: frames of a sensor that were not read, and one that was of no use.
  void CountSkipped(std::int64_t num_frames);
  void Reject(const std::string& input, const std::string& why);

 private:
  void AddSubscription(std::vector<Port> ports, PartsHandler handler);
  std::string AddOutput(Port port);  // its channel on the wire

  Shell* shell_;
};

void PublishEncoded(Shell* shell, const std::string& channel, const Bytes& message);

template <typename Message>
Port PortOf(const Channel<Message>& channel) {
  return {channel.name, Message::getTypeName()};
}

template <typename Message>
Message DecodePart(const Part& part) {
  Message message;
  const int size = static_cast<int>(part->size());
  if (message.decode(part->data(), 0, size) != size) {
    throw std::runtime_error(std::string("not a ") + Message::getTypeName());
  }
  return message;
}

template <typename Message>
void Publisher<Message>::Publish(const Message& message) const {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const int size = message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  if (size < 0) throw std::logic_error(channel_ + ": message does not encode");
  bytes.resize(static_cast<std::size_t>(size));
  PublishEncoded(shell_, channel_, bytes);
}

template <typename Message>
void Bus::Subscribe(const Channel<Message>& channel, Handler<Message> handler) {
  AddSubscription({PortOf(channel)}, [handler = std::move(handler)](const Parts& parts) {
    handler(DecodePart<Message>(parts[0]));
  });
}

template <typename A, typename B>
void Bus::SubscribeJoined(const Channel<A>& a, const Channel<B>& b, Handler<A, B> handler) {
  AddSubscription({PortOf(a), PortOf(b)}, [handler = std::move(handler)](const Parts& parts) {
    handler(DecodePart<A>(parts[0]), DecodePart<B>(parts[1]));
  });
}

template <typename Message>
Publisher<Message> Bus::Advertise(const Channel<Message>& channel) {
  return Publisher<Message>(shell_, AddOutput(PortOf(channel)));
}

}  // namespace declutter::runtime
