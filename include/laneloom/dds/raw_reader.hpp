#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// Reads the topic of T (as for Reader) without looking into its messages: well-formed or not, they come as
/// they went over the wire, for a recording to keep. cdr.hpp turns them into T.
/// Throws std::runtime_error when it can't be made, and ConfigError if the participant has a Reader or Writer
/// of the topic.
template <class T>
class RawReader {
 public:
  /// Called by threads of DDS, one message at a time, as the callbacks of a Reader are (ReaderCallbacks).
  using Callback = std::function<void(const WriterId& writer, std::vector<std::uint8_t>&& message)>;

  /// Keeps the participant alive. `callback` may be called before the constructor returns.
  RawReader(const Participant& participant, Callback callback);
  RawReader(RawReader&&) noexcept;
  RawReader& operator=(RawReader&&) noexcept;
  ~RawReader();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
