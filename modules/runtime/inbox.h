#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "modules/runtime/part.h"

namespace declutter::runtime {

// A complete frame of a subscription, waiting for the worker.
struct Delivery {
  std::size_t subscription;
  std::int64_t utime;  // [us] of the sensor
  Parts parts;
};

// What the I/O thread puts in and the worker takes out, oldest first. At the sensor's rate a newer
// frame takes the place of the one waiting for the same subscription: an overloaded module skips
// frames instead of lagging behind. In a lossless run every frame waits its turn.
class Inbox {
 public:
  Inbox(bool lossless, std::size_t capacity) : lossless_(lossless), capacity_(capacity) {}

  // False when a frame was lost for it: an older one that it replaced, or itself when a lossless
  // inbox is full.
  bool Put(Delivery delivery);

  std::optional<Delivery> Take();

  // Waits for a delivery until deadline or until Close().
  std::optional<Delivery> TakeUntil(std::chrono::steady_clock::time_point deadline);

  // From now on every frame waits, in a live run at most kMaxHeld, until Release().
  void Hold();

  // Drops what a predecessor has handled, up to last_utime [us]. The worker gets the rest, also at
  // the sensor's rate.
  void Release(std::int64_t last_utime);

  // Waits for Release() or Close().
  void AwaitRelease();

  // Wakes the worker for the last time: a lossless inbox is still emptied, else what waits is
  // dropped.
  void Close();

  bool closed() const;
  std::size_t size() const;

  static constexpr std::size_t kMaxHeld = 64;

 private:
  std::optional<Delivery> TakeLocked();
  bool Keep(Delivery delivery);

  const bool lossless_;
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Delivery> waiting_;
  std::size_t num_held_ = 0;  // of those waiting, from the front: not to be replaced
  bool holds_ = false;
  bool closed_ = false;
};

}  // namespace declutter::runtime
