#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "evaluation/inputs.hpp"

namespace laneloom::python {

/// The items of a file, read ahead by a thread of its own. It needs no GIL. One thread at a time may ask for
/// the next item.
template <class T>
class Stream {
 public:
  using Put = std::function<void(T)>;
  /// Reads the file and puts its items.
  using Read = std::function<evaluation::InputAccount(const std::string& file, const Put& put,
                                                      const evaluation::InputReading& reading)>;

  Stream(std::string file, Read read)
      : file_(std::move(file)), thread_([this, read = std::move(read)] { run(read); }) {}
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  /// The next item; empty: there is none. Throws what the reading threw.
  std::optional<T> next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !items_.empty() || done_; });
    if (items_.empty()) {
      if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
      return std::nullopt;
    }
    T item = std::move(items_.front());
    items_.pop_front();
    changed_.notify_all();
    return item;
  }

  const std::string& file() const { return file_; }
  /// What was passed over. Complete once next() was empty; it tells that once.
  evaluation::InputAccount account() { return std::exchange(account_, evaluation::InputAccount()); }

 private:
  /// Is thrown to end the reading when nobody asks any more.
  struct Stopped {};
  static constexpr std::size_t kAhead = 32;

  void put(T item) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return items_.size() < kAhead || stopped_; });
    if (stopped_) throw Stopped();
    items_.push_back(std::move(item));
    changed_.notify_all();
  }

  void run(const Read& read) {
    std::exception_ptr error;
    evaluation::InputAccount account;
    try {
      // Also a file with nothing to put is read no further.
      const evaluation::InputReading reading{.on_step = [this](double /*share*/) {
        if (stopped_) throw Stopped();
      }};
      account = read(
          file_, [this](T item) { put(std::move(item)); }, reading);
    } catch (const Stopped&) {
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    account_ = std::move(account);
    error_ = error;
    done_ = true;
    changed_.notify_all();
  }

  std::string file_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> items_;
  evaluation::InputAccount account_;
  std::exception_ptr error_;
  bool done_ = false;
  std::atomic<bool> stopped_ = false;
  std::thread thread_;
};

}  // namespace laneloom::python
