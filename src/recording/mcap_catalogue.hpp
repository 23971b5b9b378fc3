#pragma once

#include <map>
#include <memory>

#include "recording/mcap_format.hpp"

namespace laneloom::recording {

/// The schemas and channels of an MCAP file, gathered as their records are met. Throws std::runtime_error
/// where they contradict each other, or take more than `max_bytes` in all.
class McapCatalogue {
 public:
  explicit McapCatalogue(std::uint64_t max_bytes) : max_bytes_(max_bytes) {}

  /// Adds the schema or the channel of a record's content.
  void add_schema(ByteView record);
  void add_channel(ByteView record);

  /// The reference stays valid until the catalogue is moved or destroyed.
  const McapChannel& channel(std::uint16_t id) const;

 private:
  void count(std::size_t bytes);

  std::uint64_t max_bytes_;
  std::uint64_t bytes_ = 0;
  std::map<std::uint16_t, std::shared_ptr<const McapSchema>> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
};

}  // namespace laneloom::recording
