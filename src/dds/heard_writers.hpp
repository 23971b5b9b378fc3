#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// How a sample is cut into fragments.
struct Fragmentation {
  std::int64_t sequence = 0;
  std::uint32_t sample_bytes = 0;
  std::uint32_t fragment_bytes = 0;
  bool operator==(const Fragmentation&) const = default;
  std::uint32_t fragments() const { return (sample_bytes + fragment_bytes - 1) / fragment_bytes; }
};

/// Sequence numbers in a row.
struct SequenceNumbers {
  std::int64_t from = 0, to = 0;  ///< `to` is not one of them
};

/// The newest numbers of remote writers, by which a stranger's leap in their name is seen. Memory is bounded:
/// the writer that was heard least recently is forgotten first.
class HeardWriters {
 public:
  /// Whether a writer may have come to this sequence number.
  bool may_have_sent(const WriterId& writer, std::int64_t sequence, std::int64_t now_ns) const;
  /// Whether a writer may tell that it skips so many numbers more.
  bool may_skip(const WriterId& writer, std::int64_t numbers, std::int64_t now_ns) const;
  /// How many of the numbers a writer has not just skipped. It tells of those that a slow reader asks for at
  /// each heartbeat anew, and all readers hear it.
  std::int64_t newly_skipped(const WriterId& writer, const SequenceNumbers& numbers) const;
  /// Whether no other fragmentation of the same sample is known.
  bool is_cut_like(const WriterId& writer, const Fragmentation& cut) const;

  void note(const WriterId& writer, std::int64_t sequence, std::int64_t now_ns);
  void note(const WriterId& writer, const Fragmentation& cut, std::int64_t now_ns);
  void note_skipped(const WriterId& writer, const SequenceNumbers& numbers, std::int64_t now_ns);

 private:
  struct Heard {
    WriterId writer{};
    std::int64_t newest = 0;
    std::int64_t heard_ns = 0;
    std::array<Fragmentation, 8> cuts{};  ///< the newest ones, in a ring
    std::size_t next_cut = 0;
    std::int64_t skipped = 0;  ///< numbers, less those that were forgotten until skipped_ns
    std::int64_t skipped_ns = 0;
    SequenceNumbers last_skipped{};  ///< counted; without a gap

    std::int64_t skipped_at(std::int64_t now_ns) const;
  };

  Heard& heard(const WriterId& writer, std::int64_t now_ns);
  void bring_to_front(const WriterId& writer);
  const Heard* find(const WriterId& writer) const;

  std::list<Heard> newest_first_;
  std::map<WriterId, std::list<Heard>::iterator> by_writer_;
};

}  // namespace laneloom::dds
