#include "recording/mcap_reader.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace laneloom::recording {
namespace {

constexpr std::uint64_t kMaxCatalogueBytes = 64U << 20U;

McapMessage message_of(ByteView record, const McapCatalogue& catalogue) {
  ByteReader reader(record);
  McapMessage message;
  message.channel = &catalogue.channel(reader.number<std::uint16_t>());
  message.sequence = reader.number<std::uint32_t>();
  message.log_time_ns = reader.number<std::uint64_t>();
  message.publish_time_ns = reader.number<std::uint64_t>();
  message.data = reader.bytes(reader.remaining());
  return message;
}

}  // namespace

McapReader::McapReader(const std::string& path, const RecordingLimits& limits)
    : file_(path),
      limits_(limits),
      catalogue_(std::min(kMaxCatalogueBytes, limits.max_chunk_bytes)),
      contents_(list_contents(file_, limits_, catalogue_)) {
  sort_by_time();
}

void McapReader::sort_by_time() {
  const auto& sections = contents_.sections;
  by_time_.resize(sections.size());
  std::iota(by_time_.begin(), by_time_.end(), std::size_t{0});
  std::ranges::stable_sort(by_time_, {}, [&](std::size_t number) { return sections[number].start_ns; });
  if (contents_.has_summary || std::ranges::is_sorted(by_time_)) return;
  // A channel may be described in a chunk that is read later than the channel's messages.
  for (const auto& section : sections) learn_channels(section);
}

void McapReader::learn_channels(const McapSection& section) try {
  load(file_, section, limits_, 0, catalogue_);
} catch (const std::runtime_error&) {
  // A damaged section is reported when it is opened. The other sections are read all the same.
}

bool McapReader::OpenSection::operator<(const OpenSection& other) const {
  return std::pair(other.entry().log_time_ns, other.number) < std::pair(entry().log_time_ns, number);
}

std::optional<McapMessage> McapReader::next() {
  if (told_damages_ < contents_.damages.size()) throw contents_.damages[told_damages_++];
  if (delivered_) advance_first();
  delivered_ = false;
  while (unopened_ < by_time_.size() && (open_.empty() || contents_.sections[by_time_[unopened_]].start_ns <=
                                                              open_.front().entry().log_time_ns)) {
    open(by_time_[unopened_++]);
  }
  if (open_.empty()) {
    check_count();
    return std::nullopt;
  }
  delivered_ = true;
  return at_offset(file_, open_.front().section.offset,
                   [&] { return message_of(open_.front().entry().message, catalogue_); });
}

double McapReader::progress() const {
  if (by_time_.empty()) return 1.0;
  return static_cast<double>(unopened_) / static_cast<double>(by_time_.size());
}

void McapReader::open(std::size_t number) {
  LoadedSection section = load(file_, contents_.sections[number], limits_, open_bytes_, catalogue_);
  if (section.entries.empty()) return;
  count_ += section.entries.size();
  open_bytes_ += section.bytes;
  open_.push_back({std::move(section), number});
  std::push_heap(open_.begin(), open_.end());
}

/// Compares the number of messages with the file's statistics: a chunk whose opcode is damaged is passed over
/// as an unknown record.
void McapReader::check_count() {
  const auto expected = std::exchange(contents_.message_count, std::nullopt);  // so that it is reported once
  if (!expected || *expected == count_) return;
  throw Damage(file_.path(), "its end",
               std::to_string(count_) + " messages were found, of " + std::to_string(*expected));
}

void McapReader::advance_first() {
  std::pop_heap(open_.begin(), open_.end());
  OpenSection& first = open_.back();
  if (++first.next < first.section.entries.size()) {
    std::push_heap(open_.begin(), open_.end());
  } else {
    open_bytes_ -= first.section.bytes;
    open_.pop_back();
  }
}

}  // namespace laneloom::recording
