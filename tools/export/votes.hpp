#pragma once

#include <algorithm>
#include <cstddef>

namespace laneloom::exports {

/// The belief of the drives past a place in a line there: log odds, to a limit, so that a road that changed
/// is believed after a few drives.
struct Votes {
  double belief = kSeen;       ///< log odds that the line is there
  std::size_t last_drive = 0;  ///< the last one that saw it
  std::size_t first_drive = 0;
  int against = 0;  ///< drives that passed before the first one saw it
  int seen = 1;     ///< drives

  /// A line that `drive` sees for the first time, at a place that some drives passed before.
  static Votes of_new(std::size_t drive, int passed_before) {
    return {.belief = std::max(kSeen + kUnseen * passed_before, -kMost),
            .last_drive = drive,
            .first_drive = drive,
            .against = passed_before};
  }
  void see(std::size_t drive) {
    if (drive == last_drive) return;
    belief = std::min(belief + kSeen, kMost);
    last_drive = drive;
    ++seen;
  }
  void pass(std::size_t drive) {
    if (drive != last_drive) belief = std::max(belief + kUnseen, -kMost);
  }
  bool believed() const { return belief > 0.0; }

  // A drive sees about 85 % of the lines beside it, and a line where none is at 5 % of all places.
  static constexpr double kSeen = 2.8;     // ln(0.85 / 0.05)
  static constexpr double kUnseen = -1.8;  // ln(0.15 / 0.95)
  static constexpr double kMost = 4.0;
};

}  // namespace laneloom::exports
