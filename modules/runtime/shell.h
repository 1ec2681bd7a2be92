#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "modules/runtime/health.h"
#include "modules/runtime/inbox.h"
#include "modules/runtime/joiner.h"
#include "modules/runtime/journal.h"
#include "modules/runtime/message_layout.h"
#include "modules/runtime/part.h"

namespace declutter::runtime {

// The process around a module, without its links to the world: messages come in through Receive()
// (from the network or from a log) and go out through a sink. Receive(), Stop(), Release() and
// PublishStatus() may be called from another thread than the rest.
class Shell {
 public:
  struct Identity {
    std::string name;                          // in the graph
    std::string program;                       // of the executable
    std::map<std::string, std::string> remap;  // channel of the module -> channel on the wire
    bool lossless = false;
  };
  enum class State : std::int8_t { kStarting, kRunning, kFinished, kFailed };
  using Sink = std::function<void(const std::string& channel, const Bytes& message)>;
  using PollFunction = std::function<std::optional<double>()>;

  explicit Shell(Identity identity);

  // The module's side, through Bus.
  void AddSubscription(std::vector<Port> ports, PartsHandler handler);
  std::string AddOutput(Port port);
  void OnStart(std::function<void()> start) { start_ = std::move(start); }
  void Poll(PollFunction poll) { poll_ = std::move(poll); }
  void Publish(const std::string& channel, const Bytes& message);
  void Warn(const std::string& cause, const std::string& text);
  void Fail(const std::string& text);
  void SetTrouble(const std::string& text);
  void Note(const std::string& text) { journal_.Write(text, text); }
  void CountSkipped(std::int64_t num_frames) { health_.Skipped(num_frames); }
  void Reject(const std::string& channel, const std::string& why);
  bool lossless() const { return identity_.lossless; }

  // What the module asked for; channels as on the wire.
  const std::vector<Port>& inputs() const { return inputs_; }
  const std::vector<Port>& outputs() const { return outputs_; }
  // Names of the module's channels, before --remap.
  const std::vector<std::string>& channels() const { return channels_; }
  bool is_closed() const { return inbox_.closed(); }
  bool is_source() const { return static_cast<bool>(poll_); }

  void Connect(Sink sink) { sink_ = std::move(sink); }

  // Checks a message and puts it in the mailbox. Damaged ones are counted and reported.
  void Receive(const std::string& channel, const std::uint8_t* data, std::size_t size) noexcept;

  // All times [us] at which messages will come, by channel. A message whose partner in a join is
  // not among them is left out, which loses nothing.
  void ExpectOnly(std::map<std::string, std::set<std::int64_t>> utimes);
  std::int64_t num_left_out() const { return num_left_out_; }

  // Takes the place of another process: handles nothing until Release(), and then what is later
  // than the last frame of that process [us].
  void Hold() { inbox_.Hold(); }
  void Release(std::int64_t last_utime) { inbox_.Release(last_utime); }
  void AwaitRelease() { inbox_.AwaitRelease(); }

  // Calls what the module wants called before the first message.
  void Start();

  // Handles frames and polls until the source is finished or Stop() was called. Throws what the
  // module throws as ConfigError or as its own bug.
  void Work();

  // Handles what is in the mailbox.
  void HandleWaiting();

  // Ends Work(), in a lossless run after everything in the mailbox.
  void Stop() { inbox_.Close(); }

  void PublishStatus(State state);

  bool failed() const { return failed_; }
  std::int64_t num_handled() const { return health_.num_handled(); }
  std::int64_t num_rejected() const { return health_.num_rejected(); }
  const Identity& identity() const { return identity_; }

 private:
  struct Subscription {
    std::vector<Port> ports;
    std::vector<const MessageLayout*> layouts;
    PartsHandler handler;
    Joiner joiner;
  };

  std::string Wire(const std::string& channel);
  void Accept(std::size_t subscription, std::size_t port, const std::uint8_t* data,
              std::size_t size);
  void Handle(const Delivery& delivery);
  void EndFrame(std::int64_t utime, double now_ms);
  void Skip(std::int64_t num_frames);
  bool PollOnce(std::chrono::steady_clock::time_point* next);

  const Identity identity_;
  Journal journal_;
  Health health_;
  Inbox inbox_;
  std::vector<Subscription> subscriptions_;
  std::vector<std::string> channels_;
  std::vector<Port> inputs_;
  std::vector<Port> outputs_;
  std::function<void()> start_;
  PollFunction poll_;
  Sink sink_;
  std::atomic<bool> failed_{false};
  std::optional<std::map<std::string, std::set<std::int64_t>>> expected_;
  std::int64_t num_left_out_ = 0;
  std::atomic<double> poll_since_ms_{0};  // 0: none is under way
};

}  // namespace declutter::runtime
