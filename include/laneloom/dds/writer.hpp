#pragma once

#include <cstdint>
#include <memory>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// Writes one topic; T is DetectionFrame, VehiclePose, PublishedMap, RoadMarkings or ServiceStatus.
/// Not thread-safe; throws std::runtime_error when it can't be made.
template <class T>
class Writer {
 public:
  /// Keeps the participant alive.
  explicit Writer(const Participant& participant);
  Writer(Writer&&) noexcept;
  Writer& operator=(Writer&&) noexcept;
  ~Writer();

  /// False when DDS did not take it. What exceeds the bounds of the IDL is left out: an element as a whole,
  /// and whatever refers to it. Never waits for a reader for longer than 50 ms.
  bool write(const T& message);

  /// Elements that were left out so far, and sources whose names were cut.
  std::uint64_t left_out() const;
  /// Readers that are matched now. May be called from any thread.
  int matched() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
