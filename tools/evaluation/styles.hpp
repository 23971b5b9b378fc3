#pragma once

#include <vector>

#include "evaluation/evaluation.hpp"

/// How well solid lanelines are told from dashed ones, by the project's definition.
///
/// Of the true positives among the lanelines, every metre in range that lies within 0.5 m of its truth line.
/// Truth lines of unknown style do not count. Accuracy is the share with the truth's style among those with a
/// known one; how much is unknown stands apart.
namespace laneloom::evaluation {

/// Lengths of found lanelines by their published style.
struct StyleScore {
  std::size_t right = 0;    ///< metres
  std::size_t wrong = 0;    ///< metres
  std::size_t unknown = 0;  ///< metres

  double accuracy() const;       ///< 0..1
  double unknown_share() const;  ///< 0..1, of all
};

/// Adds one frame, compared with `truth`, whose lines have at most one style each.
void add_styles(const FrameComparison& frame, const std::vector<KindLine>& truth,
                const std::vector<KindLine>& predictions, StyleScore& score);

}  // namespace laneloom::evaluation
