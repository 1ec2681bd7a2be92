#include "modules/runtime/inbox.h"

#include <algorithm>
#include <utility>

namespace declutter::runtime {

bool Inbox::Put(Delivery delivery) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (holds_) return Keep(std::move(delivery));
  if (lossless_) {
    if (waiting_.size() == capacity_) return false;
  } else {
    for (std::size_t i = num_held_; i < waiting_.size(); ++i) {
      Delivery& older = waiting_[i];
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

bool Inbox::Keep(Delivery delivery) {
  for (Delivery& older : waiting_) {
    if (older.subscription != delivery.subscription || older.utime != delivery.utime) continue;
    older = std::move(delivery);
    return true;
  }
  waiting_.push_back(std::move(delivery));
  if (waiting_.size() <= (lossless_ ? capacity_ : kMaxHeld)) return true;
  waiting_.pop_front();
  return false;
}

void Inbox::Hold() {
  const std::lock_guard<std::mutex> lock(mutex_);
  holds_ = true;
}

void Inbox::Release(std::int64_t last_utime) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto is_handled = [last_utime](const Delivery& delivery) {
    return delivery.utime <= last_utime;
  };
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), is_handled), waiting_.end());
  num_held_ = waiting_.size();
  holds_ = false;
  changed_.notify_one();
}

void Inbox::AwaitRelease() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !holds_; });
}

std::optional<Delivery> Inbox::TakeLocked() {
  if (waiting_.empty()) return std::nullopt;
  std::optional<Delivery> first = std::move(waiting_.front());
  waiting_.pop_front();
  if (num_held_ > 0) --num_held_;
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
  if (!lossless_ || holds_) waiting_.clear();
  holds_ = false;
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
