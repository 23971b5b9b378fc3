#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace laneloom::commands {

/// A queue of the newest 64 events; of more, the oldest are dropped.
template <class Event>
class NewestEvents {
 public:
  bool empty() const { return events_.empty(); }

  void push(Event event) {
    events_.push_back(std::move(event));
    if (events_.size() > kCapacity) events_.pop_front();
  }

  /// The next event. Empty: there is none.
  std::optional<Event> take() {
    if (events_.empty()) return std::nullopt;
    Event event = std::move(events_.front());
    events_.pop_front();
    return event;
  }

 private:
  static constexpr std::size_t kCapacity = 64;
  std::deque<Event> events_;
};

/// Passes events from DDS's threads to ours. The queue decides which are kept, and which are taken together.
template <class Event, class Queue = NewestEvents<Event>>
class Inbox {
 public:
  void put(Event event) {
    const std::lock_guard lock(mutex_);
    queue_.push(std::move(event));
    arrived_.notify_one();
  }

  /// Takes from the queue as soon as it has an event, or after `patience`.
  auto take(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, patience, [this] { return !queue_.empty(); });
    return queue_.take();
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  Queue queue_;
};

}  // namespace laneloom::commands
