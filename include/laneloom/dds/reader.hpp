#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// Functions that threads of DDS call. `numbered`, `sample` and `refused` are called one at a time. The
/// others may be called by other threads meanwhile. All must return quickly, must not use the participant,
/// must not make, move or end readers or writers, and must not throw (an exception is swallowed). Any of them
/// may be empty.
template <class T>
struct ReaderCallbacks {
  std::function<void(T&&)> sample;  ///< a valid sample
  /// A sample that is no valid T. `reason` is one of these stable names: crc, data_id, malformed,
  /// unknown_enum, not_text, not_finite, not_a_rotation, wrong_frame, wrong_size, coordinate.
  std::function<void(std::string_view reason)> refused;
  /// Is called before each `sample` or `refused`: `writer` wrote it, as its sample of this `number`. Is also
  /// called for a message by which a writer only tells that it ends.
  std::function<void(const WriterId& writer, std::uint64_t number)> numbered;
  /// The number of writers that are matched now. Is called when it changes.
  std::function<void(int writers)> matched;
  /// The number of writers that assert their liveliness now. Is called when it changes, so not while there
  /// never was a writer.
  std::function<void(int writers)> alive;
  /// The number of deadlines missed, in total. Is called at each one, again and again while no sample comes;
  /// not before the first sample. Maps and road markings alone have a deadline.
  std::function<void(std::uint64_t total)> deadline_missed;
};

/// Reads one topic; T as for Writer. Input topics are read best effort, so that writers of both kinds match.
/// Detections are also read reliably, from writers that are reliable; each sample comes once. What the
/// service publishes is read reliably, and a new reader gets the newest sample that there is.
///
/// After the destructor no callback runs: what the callbacks use must live until then. An assignment ends
/// the reader that was there, likewise. A reader that was moved from can only be assigned to or destroyed.
///
/// Throws std::runtime_error when it can't be made (NotPermitted with security), and ConfigError if the
/// participant has a RawReader or RawWriter of the topic.
template <class T>
class Reader {
 public:
  /// Keeps the participant alive. `callbacks` may be called before the constructor returns.
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
