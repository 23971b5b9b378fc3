#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "dds/heard_writers.hpp"

namespace laneloom::dds {

/// Announcements of discovery that come in fragments. Only as a whole they tell whether they are sound, and
/// Fast DDS reads them once the last fragment is there. Of more than 32, the oldest is forgotten. Not
/// thread-safe.
class FragmentedAnnouncements {
 public:
  /// Whether fragments from `first` on (counted from 1) may pass. Fragments that came before are to be the
  /// same again, and those that make an announcement whole are to make it sound. An announcement has at most
  /// 64 KiB.
  bool take(const WriterId& writer, const Fragmentation& cut, std::size_t first,
            std::span<const std::uint8_t> bytes);

 private:
  struct Announcement {
    WriterId writer{};
    Fragmentation cut;
    std::vector<std::uint8_t> bytes;
    std::vector<bool> has_come;  ///< by fragment
  };
  Announcement& announcement(const WriterId& writer, const Fragmentation& cut);

  std::deque<Announcement> newest_;
};

}  // namespace laneloom::dds
