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
  /// Counts what happened once or several times.
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
  /// 0 for what was never counted.
  std::uint64_t operator[](std::string_view name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? 0 : found->second;
  }
  /// In the order of their names.
  const std::map<std::string, std::uint64_t, std::less<>>& values() const { return values_; }

 private:
  std::map<std::string, std::uint64_t, std::less<>> values_;
};

}  // namespace laneloom
