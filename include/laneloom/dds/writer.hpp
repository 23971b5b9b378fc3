#pragma once

#include <cstdint>
#include <memory>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// Writes one topic; T is DetectionFrame, VehiclePose, TrackedObjects, NextTurn, PublishedMap, RoadMarkings
/// or ServiceStatus. Not thread-safe; throws std::runtime_error when it can't be made.
template <class T>
class Writer {
 public:
  /// Keeps the participant alive.
  explicit Writer(const Participant& participant);
  Writer(Writer&&) noexcept;
  Writer& operator=(Writer&&) noexcept;
  ~Writer();

  /// Returns false when DDS did not take the message. An element that exceeds the bounds of the IDL is left
  /// out as a whole, and so are all that refer to it. Never waits for a reader for longer than 50 ms.
  bool write(const T& message);

  /// Number of elements that were left out so far, and of sources whose names were cut.
  std::uint64_t left_out() const;
  /// Number of readers that are matched now. May be called from any thread.
  int matched() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
