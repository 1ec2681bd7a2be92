#include "modules/runtime/inbox.h"

#include <utility>

namespace declutter::runtime {

bool Inbox::Put(Delivery delivery) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (lossless_) {
    if (waiting_.size() == capacity_) return false;
  } else {
    for (Delivery& older : waiting_) {
      if (older.subscription != delivery.subscription) continue;
      const bool sent_again = older.utime == delivery.utime;
      older = std::move(delivery);
      return sent_again;
    }
  }
  waiting_.push_back(std::move(delivery));
  changed_.notify_one();
  return true;
}

std::optional<Delivery> Inbox::TakeLocked() {
  if (waiting_.empty()) return std::nullopt;
  std::optional<Delivery> first = std::move(waiting_.front());
  waiting_.pop_front();
  return first;
}

std::optional<Delivery> Inbox::Take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return TakeLocked();
}

std::optional<Delivery> Inbox::TakeUntil(std::chrono::steady_clock::time_point deadline) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_until(lock, deadline, [this] { return closed_ || !waiting_.empty(); });
  return TakeLocked();
}

void Inbox::Close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  if (!lossless_) waiting_.clear();
  changed_.notify_one();
}

bool Inbox::closed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return closed_;
}

std::size_t Inbox::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return waiting_.size();
}

}  // namespace declutter::runtime
