#include "dds/rtps_announcements.hpp"

#include <algorithm>

#include "dds/rtps_parameters.hpp"

namespace laneloom::dds {
namespace {

constexpr std::size_t kMostAnnouncements = 32;
constexpr std::uint32_t kLargestAnnouncement_bytes = 1U << 16U;

}  // namespace

bool FragmentedAnnouncements::take(const WriterId& writer, const Fragmentation& cut, std::size_t first,
                                   std::span<const std::uint8_t> bytes) {
  if (cut.sample_bytes > kLargestAnnouncement_bytes) return false;
  Announcement& known = announcement(writer, cut);
  for (std::size_t fragment = first - 1; !bytes.empty(); ++fragment) {
    const auto part = bytes.first(std::min<std::size_t>(cut.fragment_bytes, bytes.size()));
    const auto place = std::span(known.bytes).subspan(fragment * cut.fragment_bytes, part.size());
    if (known.has_come[fragment] && !std::ranges::equal(part, place)) return false;
    std::ranges::copy(part, place.begin());
    known.has_come[fragment] = true;
    bytes = bytes.subspan(part.size());
  }
  const bool is_whole = std::ranges::all_of(known.has_come, [](bool has_come) { return has_come; });
  return !is_whole || is_sound_announcement(known.bytes);
}

FragmentedAnnouncements::Announcement& FragmentedAnnouncements::announcement(const WriterId& writer,
                                                                             const Fragmentation& cut) {
  const auto known = std::ranges::find_if(
      newest_, [&](const Announcement& one) { return one.writer == writer && one.cut == cut; });
  if (known != newest_.end()) return *known;
  if (newest_.size() == kMostAnnouncements) newest_.pop_front();
  return newest_.emplace_back(Announcement{writer, cut, std::vector<std::uint8_t>(cut.sample_bytes),
                                           std::vector<bool>(cut.fragments())});
}

}  // namespace laneloom::dds
