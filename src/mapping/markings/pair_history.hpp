#pragma once

#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// How often two lines were seen as one and as two, fading over about 30 frames. What the paper's
/// co-observation is to voxels, this is to lines.
struct PairHistory {
  ElementId a = kNoElement;  ///< the smaller id
  ElementId b = kNoElement;
  double together = 0.0;  ///< frames
  double apart = 0.0;     ///< frames

  template <class Archive>
  void serialize(Archive& archive) {
    archive(a, b, together, apart);
  }
};

/// Names an end of a line.
constexpr ElementId end_id(ElementId line, End end) { return 2 * line + index(end); }

/// In the order of their ids.
using PairHistories = std::vector<PairHistory>;
void sort(PairHistories& histories);

/// Null: the two have none.
const PairHistory* find(const PairHistories& histories, ElementId a, ElementId b);

/// How a frame shows two lines; neither, where it does not show both.
struct PairSighting {
  ElementId a = kNoElement;  ///< the smaller id
  ElementId b = kNoElement;
  bool together = false;
  bool apart = false;
};

/// What is known of the two, with one more frame.
PairHistory continued(const PairHistories& histories, const PairSighting& sighting);

/// The same of every pair that is in `sightings`, which are in the order of their ids; the others are
/// forgotten.
PairHistories continued(const PairHistories& histories, const std::vector<PairSighting>& sightings);

/// Whether they were seen long enough, and too seldom together.
bool seen_apart(const PairHistory& history);

/// Whether they were seen together often enough.
bool seen_together(const PairHistory& history);

}  // namespace laneloom
