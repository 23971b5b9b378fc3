#pragma once

#include <cstdint>
#include <map>

#include "laneloom/dds/reader.hpp"

namespace laneloom::dds {

/// Recognises samples that come again, by the numbers that their writers gave them.
class SampleNumbers {
 public:
  /// Whether this is the first call with this number of this writer. A number far below the newest one counts
  /// as seen.
  bool is_new(const WriterId& writer, std::uint64_t number) {
    if (writers_.size() >= kMaxWriters) writers_.clear();
    const auto [entry, first] = writers_.try_emplace(writer, Window{number, 1});
    Window& window = entry->second;
    if (first) return true;
    if (number > window.newest) {
      const std::uint64_t step = number - window.newest;
      window.seen = step < kWindow ? (window.seen << step) | 1U : 1U;
      window.newest = number;
      return true;
    }
    const std::uint64_t age = window.newest - number;
    if (age >= kWindow || (window.seen >> age & 1U) != 0) return false;
    window.seen |= std::uint64_t{1} << age;
    return true;
  }

 private:
  static constexpr std::uint64_t kWindow = 64;
  static constexpr std::size_t kMaxWriters = 1024;  // a stranger may come with ever new writers

  /// The newest numbers of a writer.
  struct Window {
    std::uint64_t newest = 0;
    std::uint64_t seen = 0;  ///< bit i: the number i below the newest came
  };
  std::map<WriterId, Window> writers_;
};

}  // namespace laneloom::dds
