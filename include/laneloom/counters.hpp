#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace laneloom {

/// Counts of what happened, by stable names. Not thread-safe.
class Counters {
 public:
  /// Adds `count` to the counter `name`.
  void add(std::string_view name, std::uint64_t count = 1) {
    const auto found = values_.find(name);
    if (found != values_.end()) {
      found->second += count;
    } else {
      values_.emplace(name, count);
    }
  }
  /// Adds all counts of others.
  void add(const Counters& others) {
    for (const auto& [name, count] : others.values_) add(name, count);
  }
  /// The count of a name; 0 if nothing was counted by it.
  std::uint64_t operator[](std::string_view name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? 0 : found->second;
  }
  /// All counts by name, in alphabetical order.
  const std::map<std::string, std::uint64_t, std::less<>>& values() const { return values_; }

 private:
  std::map<std::string, std::uint64_t, std::less<>> values_;
};

}  // namespace laneloom
