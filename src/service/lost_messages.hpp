#pragma once

#include <algorithm>
#include <cstdint>
#include <map>

#include "laneloom/dds/reader.hpp"

namespace laneloom::service {

/// Counts the messages that never arrived, by the numbers that their writers gave them. A message that comes
/// after newer ones is no longer counted as lost.
class LostMessages {
 public:
  /// Notes that a message arrived. Each number of a writer may be noted once.
  void note(const dds::WriterId& writer, std::uint64_t number) {
    if (writers_.size() >= kMaxWriters) forget();
    Numbers& numbers = writers_.try_emplace(writer, Numbers{number, number, 0}).first->second;
    numbers.first = std::min(numbers.first, number);
    numbers.newest = std::max(numbers.newest, number);
    ++numbers.arrived;
  }
  std::uint64_t total() const {
    std::uint64_t lost = of_forgotten_;
    for (const auto& [writer, numbers] : writers_)
      lost += numbers.newest - numbers.first + 1 - numbers.arrived;
    return lost;
  }

 private:
  /// The smallest and the largest number of a writer, and how many arrived.
  struct Numbers {
    std::uint64_t first = 0, newest = 0, arrived = 0;
  };

  void forget() {
    of_forgotten_ = total();
    writers_.clear();
  }

  static constexpr std::size_t kMaxWriters = 1024;  // beyond, all are forgotten: one alone may return
  std::map<dds::WriterId, Numbers> writers_;
  std::uint64_t of_forgotten_ = 0;
};

}  // namespace laneloom::service
