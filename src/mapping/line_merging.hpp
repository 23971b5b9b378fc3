#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/line_map.hpp"

namespace laneloom {

/// How often two lines that lie side by side were seen in the same frame: two real lines are, a line and its
/// double are not. What the paper's co-observation is to voxels, this is to lines.
struct LinePair {
  ElementId a = kNoElement;  ///< the smaller id
  ElementId b = kNoElement;
  double together = 0.0;  ///< frames that saw both, fading
  double apart = 0.0;     ///< frames that saw one of them, fading

  template <class Archive>
  void serialize(Archive& archive) {
    archive(a, b, together, apart);
  }
};

/// Counts which neighbouring lines are seen together, and takes away the double of a line: of two that lie
/// side by side and are not seen together, the one with less evidence. `observed` says for every line which
/// of its stations were observed in this frame; lines that are newer than it may follow. Pairs are in the
/// order of their ids.
void merge_doubles(const StationsObserved& observed, const FusionConfig& config, std::vector<Line>& lines,
                   std::vector<LinePair>& pairs);

}  // namespace laneloom
