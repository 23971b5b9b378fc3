#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// Called by threads of DDS. They must return quickly, not make or end readers or writers, and not throw
/// (what they throw is swallowed). Any of them may be empty.
template <class T>
struct ReaderCallbacks {
  std::function<void(T&&)> sample;
  /// A sample that is no valid T, with a stable name of the reason:
  /// crc, data_id, malformed, unknown_enum, not_text, not_finite, not_a_rotation, wrong_frame, wrong_size.
  std::function<void(std::string_view reason)> refused;
  /// Before each of these: who wrote it, and the number that it has among its writer's samples.
  std::function<void(const WriterId& writer, std::uint64_t number)> numbered;
  std::function<void(int writers)> matched;            ///< writers that are matched now
  std::function<void(int writers)> alive;              ///< writers that assert their liveliness now
  std::function<void(std::uint64_t)> deadline_missed;  ///< in total
};

/// Reads one topic; T as for Writer. Input topics are read best effort, so that writers of both kinds match.
/// After the destructor no callback runs. Throws std::runtime_error when it can't be made.
template <class T>
class Reader {
 public:
  /// `callbacks` may be called from then on.
  Reader(const Participant& participant, ReaderCallbacks<T> callbacks);
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;
  ~Reader();

  /// Writers that are matched now. May be called from any thread.
  int matched() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
