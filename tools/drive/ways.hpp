#pragma once

#include <vector>

#include "laneloom/types.hpp"

/// The lanes of a local map as ways to go, in the sense in which they are walked.
namespace laneloom {

struct Way {
  const Lane* lane = nullptr;
  bool against = false;  ///< the order of the lane's points

  Polyline centerline() const;
  /// It is known that traffic comes the other way.
  bool oncoming() const;
};

/// From the end of one way to the beginning of another.
struct Passage {
  Way to;
  Polyline path;  ///< across the gap, also where the map gives none; empty: the ways meet
  Linkage::Turn turn = Linkage::Turn::unknown;
  double confidence = 0.0;
};

/// Where the map leads on from the end of `way`.
std::vector<Passage> passages(const LocalMap& map, const Way& way);

/// The passage to take for the wanted turn: the one that makes it, else straight on, else the likeliest;
/// null where there is none.
const Passage* choose(const std::vector<Passage>& passages, Linkage::Turn wanted);

/// A way beside `way` to change to where it narrows and ends: same sense, not known to be oncoming, across a
/// boundary that may be crossed, and going on for longer. Its lane is null where there is none.
Way beside(const LocalMap& map, const Way& way);

}  // namespace laneloom
