#pragma once

#include <fastdds/rtps/common/SampleIdentity.h>

#include <cstdint>
#include <map>

namespace laneloom::dds {

/// Tells by the writers' own numbers how many samples never arrived, whatever their contents.
class LostSamples {
 public:
  /// How many are missing between this sample and the one before it of the same writer.
  std::uint64_t before(const eprosima::fastrtps::rtps::SampleIdentity& sample) {
    const std::uint64_t number = sample.sequence_number().to64long();
    if (newest_.size() >= kMaxWriters) newest_.clear();
    const auto [writer, first] = newest_.try_emplace(sample.writer_guid(), number);
    if (first || number <= writer->second) return 0;
    const auto missing = number - writer->second - 1;
    writer->second = number;
    return missing;
  }

 private:
  static constexpr std::size_t kMaxWriters = 1024;  // none is forgotten alone: it may come back
  std::map<eprosima::fastrtps::rtps::GUID_t, std::uint64_t> newest_;
};

}  // namespace laneloom::dds
