#pragma once

#include <array>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::markings {

/// The deviation at arc length `at_m`, interpolated between the vertices, which lie at `arc_m`.
double deviation_at(const std::vector<double>& arc_m, const std::vector<double>& deviations_m, double at_m);

/// Votes of detections, by style.
using StyleVotes = std::array<double, kMarkingStyleCount>;

/// The style that has the configured share of the votes; of equals, solid. Unknown: no style has it.
MarkingStyle voted(const StyleVotes& votes, const StyleConfig& config);

/// Appends the style of the next stretch. Extends the last stretch if it has the same style.
void append_style(std::vector<StyleRange>& styles, const StyleRange& next);

/// The length of a marking's dashed stretches minus that of its solid ones, within a range.
double dashed_excess_m(const Marking& marking, const Stretch& range);

/// The stretch of a marking between two arc lengths, with its styles and deviations.
Marking slice(const Marking& marking, const Stretch& stretch);

/// Lets the marking run in the other direction.
void reverse(Marking& marking);

/// Appends `next` to `marking`, which keeps its id. The status is that of the longer of the two. The gap
/// between them is bridged straight; its style is unknown.
void append(Marking& marking, const Marking& next);

}  // namespace laneloom::markings
