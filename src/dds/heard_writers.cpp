#include "dds/heard_writers.hpp"

#include <algorithm>

namespace laneloom::dds {
namespace {

constexpr std::size_t kMostWriters = 4096;
// Fast DDS walks over all numbers that a heartbeat skips, with the reader locked: some ms for so many.
constexpr std::int64_t kLongestLeap = 1 << 20;
// A writer that has been silent for longer may have sent anything in a network that was cut.
constexpr std::int64_t kMemory_ns = 60'000'000'000;
// A writer may have sent so many messages before it was heard: 100 a second for more than a year.
constexpr std::int64_t kLastUnheard = std::int64_t{1} << 32;

// Fast DDS keeps an entry for each number that a writer skips, as long as one before it is missing: 48 bytes.
constexpr std::int64_t kMostSkipped = 1 << 16;
constexpr std::int64_t kForgetsOne_ns = 4'000'000;

/// Whether a writer announces endpoints. It sends no more than one message for each change of one.
bool announces_endpoints(const WriterId& writer) {
  return writer[12] == 0 && writer[13] == 0 && (writer[14] >= 2 && writer[14] <= 4) &&
         (writer[15] == 0xc2 || writer[15] == 0xc3);
}

}  // namespace

const HeardWriters::Heard* HeardWriters::find(const WriterId& writer) const {
  // Fragments come in a row.
  if (!newest_first_.empty() && newest_first_.front().writer == writer) return &newest_first_.front();
  const auto found = by_writer_.find(writer);
  return found == by_writer_.end() ? nullptr : &*found->second;
}

bool HeardWriters::may_have_sent(const WriterId& writer, std::int64_t sequence, std::int64_t now_ns) const {
  const Heard* heard = find(writer);
  if (heard && (now_ns - heard->heard_ns <= kMemory_ns || sequence <= heard->newest))
    return sequence <= heard->newest + kLongestLeap;
  return sequence <= (announces_endpoints(writer) ? kLongestLeap : kLastUnheard);
}

std::int64_t HeardWriters::Heard::skipped_at(std::int64_t now_ns) const {
  return std::max<std::int64_t>(0, skipped - (now_ns - skipped_ns) / kForgetsOne_ns);
}

bool HeardWriters::may_skip(const WriterId& writer, std::int64_t numbers, std::int64_t now_ns) const {
  const Heard* heard = find(writer);
  return numbers + (heard ? heard->skipped_at(now_ns) : 0) <= kMostSkipped;
}

bool HeardWriters::is_cut_like(const WriterId& writer, const Fragmentation& cut) const {
  const Heard* heard = find(writer);
  return !heard || std::ranges::none_of(heard->cuts, [&](const Fragmentation& known) {
    return known.sequence == cut.sequence && known != cut;
  });
}

void HeardWriters::note(const WriterId& writer, std::int64_t sequence, std::int64_t now_ns) {
  auto& known = heard(writer, now_ns);
  known.newest = std::max(known.newest, sequence);
}

void HeardWriters::note(const WriterId& writer, const Fragmentation& cut, std::int64_t now_ns) {
  auto& known = heard(writer, now_ns);
  if (std::ranges::find(known.cuts, cut) != known.cuts.end()) return;
  known.cuts[known.next_cut] = cut;
  known.next_cut = (known.next_cut + 1) % known.cuts.size();
}

std::int64_t HeardWriters::newly_skipped(const WriterId& writer, const SequenceNumbers& numbers) const {
  const Heard* heard = find(writer);
  const std::int64_t all = numbers.to - numbers.from;
  if (!heard) return all;
  const SequenceNumbers& known = heard->last_skipped;
  return all - std::max<std::int64_t>(0, std::min(numbers.to, known.to) - std::max(numbers.from, known.from));
}

void HeardWriters::note_skipped(const WriterId& writer, const SequenceNumbers& numbers, std::int64_t now_ns) {
  const std::int64_t more = newly_skipped(writer, numbers);
  auto& known = heard(writer, now_ns);
  known.skipped = known.skipped_at(now_ns) + more;
  known.skipped_ns = now_ns;
  SequenceNumbers& last = known.last_skipped;
  const bool continues = numbers.from <= last.to && last.from <= numbers.to;
  last =
      continues ? SequenceNumbers{std::min(last.from, numbers.from), std::max(last.to, numbers.to)} : numbers;
}

HeardWriters::Heard& HeardWriters::heard(const WriterId& writer, std::int64_t now_ns) {
  if (newest_first_.empty() || newest_first_.front().writer != writer) bring_to_front(writer);
  newest_first_.front().heard_ns = now_ns;
  return newest_first_.front();
}

void HeardWriters::bring_to_front(const WriterId& writer) {
  const auto found = by_writer_.find(writer);
  if (found != by_writer_.end())
    return newest_first_.splice(newest_first_.begin(), newest_first_, found->second);
  if (newest_first_.size() >= kMostWriters) {
    by_writer_.erase(newest_first_.back().writer);
    newest_first_.pop_back();
  }
  newest_first_.push_front(Heard{.writer = writer});
  by_writer_[writer] = newest_first_.begin();
}

}  // namespace laneloom::dds
