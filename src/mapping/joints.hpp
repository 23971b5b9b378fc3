#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/association.hpp"
#include "mapping/line_map.hpp"

namespace laneloom {

/// Where two lines end at each other: the one marking that they are pieces of, or two that meet?
struct Joint {
  ElementId a = kNoElement;  ///< the smaller id
  ElementId b = kNoElement;
  double together = 0.0;  ///< frames in which one detection ran along both, fading
  double apart = 0.0;     ///< frames in which each end was seen, by detections of their own, fading

  template <class Archive>
  void serialize(Archive& archive) {
    archive(a, b, together, apart);
  }
};

/// Counts for the lines that end within `max_gap_m` of each other how the frame's detections saw them. Joints
/// are in the order of their ids.
void count_joints(const std::vector<LineMatch>& matches, const std::vector<Line>& lines, double max_gap_m,
                  std::vector<Joint>& joints);

/// Whether two lines were long enough seen to be two markings, though they meet.
bool are_separate(const std::vector<Joint>& joints, ElementId a, ElementId b);

}  // namespace laneloom
