#pragma once

#include <cstdint>
#include <map>

#include "laneloom/dds/reader.hpp"

namespace laneloom {

/// Tells by the writers' own numbers how many messages never arrived, whatever their contents.
class LostMessages {
 public:
  /// How many are missing between this message and the one before it of the same writer.
  std::uint64_t before(const dds::WriterId& writer, std::uint64_t number) {
    if (newest_.size() >= kMaxWriters) newest_.clear();
    const auto [known, first] = newest_.try_emplace(writer, number);
    if (first || number <= known->second) return 0;
    const auto missing = number - known->second - 1;
    known->second = number;
    return missing;
  }

 private:
  static constexpr std::size_t kMaxWriters = 1024;  // none is forgotten alone: it may come back
  std::map<dds::WriterId, std::uint64_t> newest_;
};

}  // namespace laneloom
