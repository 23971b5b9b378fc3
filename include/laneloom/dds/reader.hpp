#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// Functions that threads of DDS call. They must return quickly, must not make or end readers or writers, and
/// must not throw (an exception is swallowed). Any of them may be empty.
template <class T>
struct ReaderCallbacks {
  std::function<void(T&&)> sample;  ///< a valid sample
  /// A sample that is no valid T. `reason` is one of these stable names: crc, data_id, malformed,
  /// unknown_enum, not_text, not_finite, not_a_rotation, wrong_frame, wrong_size, coordinate.
  std::function<void(std::string_view reason)> refused;
  /// Is called before each `sample` or `refused`: `writer` wrote it, as its sample of this `number`. Is also
  /// called for a message by which a writer only tells that it ends.
  std::function<void(const WriterId& writer, std::uint64_t number)> numbered;
  std::function<void(int writers)> matched;            ///< number of writers that are matched now
  std::function<void(int writers)> alive;              ///< number of writers that assert their liveliness now
  std::function<void(std::uint64_t)> deadline_missed;  ///< number of deadlines missed, in total
};

/// Reads one topic; T as for Writer. Input topics are read best effort, so that writers of both kinds match.
/// Detections are also read reliably, from writers that are reliable; each sample comes once. After the
/// destructor no callback runs. Throws std::runtime_error when it can't be made, and ConfigError if the
/// participant has a RawReader or RawWriter of the topic.
template <class T>
class Reader {
 public:
  /// `callbacks` may be called before the constructor returns.
  Reader(const Participant& participant, ReaderCallbacks<T> callbacks);
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;
  ~Reader();

  /// Number of writers that are matched now. May be called from any thread.
  int matched() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
