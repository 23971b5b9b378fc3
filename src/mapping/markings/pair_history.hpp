#pragma once

#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::markings {

/// How often two lines were seen as one and as two, fading over about 30 frames. It does for lines what the
/// paper's co-observation does for voxels.
struct PairHistory {
  ElementId a = kNoElement;  ///< the smaller id
  ElementId b = kNoElement;
  double together = 0.0;  ///< faded number of frames that saw them together
  double apart = 0.0;     ///< faded number of frames that saw them apart

  template <class Archive>
  void serialize(Archive& archive) {
    archive(a, b, together, apart);
  }
};

///@{
/// An id for an end of a line, and what it stands for.
constexpr ElementId end_id(ElementId line, End end) { return 2 * line + index(end); }
constexpr ElementId line_of(ElementId end_id) { return end_id / 2; }
constexpr End end_of(ElementId end_id) { return kEnds[end_id % 2]; }
///@}

/// Histories of pairs, sorted by the ids `a` and then `b`.
using PairHistories = std::vector<PairHistory>;
void sort(PairHistories& histories);

/// The history of two ids. Null: they have none.
const PairHistory* find(const PairHistories& histories, ElementId a, ElementId b);

/// How one frame shows two lines: as one, as two, or neither, if the frame does not show both.
struct PairSighting {
  ElementId a = kNoElement;  ///< the smaller id
  ElementId b = kNoElement;
  bool together = false;
  bool apart = false;
};

/// The history of the two, continued by one frame.
PairHistory continued(const PairHistories& histories, const PairSighting& sighting);

/// The histories of the pairs in `sightings`, continued by one frame. All other pairs are forgotten.
/// `sightings` are sorted by their ids.
PairHistories continued(const PairHistories& histories, const std::vector<PairSighting>& sightings);

/// Forgets the histories of an id.
void forget(ElementId id, PairHistories& histories);

/// Lets the histories of the id `from` be those of `to`. The history of more frames stays where a pair has
/// two then. A history of the two with each other is forgotten.
void rename(ElementId from, ElementId to, PairHistories& histories);

/// Whether the two were seen in enough frames, and in few of these together.
bool seen_apart(const PairHistory& history);

/// Whether the two were seen together often enough, and not less often than apart.
bool seen_together(const PairHistory& history);

}  // namespace laneloom::markings
