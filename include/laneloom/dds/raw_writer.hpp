#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// Writes the topic of T (as for Writer) from messages as they go over the wire, well-formed or not, such as
/// a RawReader received. Not thread-safe. Throws std::runtime_error when it can't be made, and ConfigError if
/// the participant has a Reader or Writer of the topic.
template <class T>
class RawWriter {
 public:
  /// Keeps the participant alive.
  explicit RawWriter(const Participant& participant);
  RawWriter(RawWriter&&) noexcept;
  RawWriter& operator=(RawWriter&&) noexcept;
  ~RawWriter();

  /// Returns false when DDS did not take the message, for example because it is longer than any message of
  /// the topic can be.
  bool write(const std::vector<std::uint8_t>& message);
  /// Number of readers that are matched now. May be called from any thread.
  int matched() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
