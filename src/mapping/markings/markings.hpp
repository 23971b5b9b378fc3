#pragma once

#include <array>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// The deviation at an arc length, between those of the vertices around it, whose arc lengths are `arc_m`.
double deviation_at(const std::vector<double>& arc_m, const std::vector<double>& deviations_m, double at_m);

/// Votes of detections for each style.
using StyleVotes = std::array<double, kMarkingStyleCount>;

/// The style with enough of the votes for one; solid of equals.
MarkingStyle voted(const StyleVotes& votes, const StyleConfig& config);

/// Appends the style of the stretch that follows.
void append_style(std::vector<StyleRange>& styles, const StyleRange& next);

/// How much longer the dashed stretches of a marking are than the solid ones, within a range.
double dashed_excess_m(const Marking& marking, const Stretch& range);

/// The stretch of a marking between two arc lengths, with its styles and deviations.
Marking slice(const Marking& marking, const Stretch& stretch);

/// The same marking, run through in the other direction.
void reverse(Marking& marking);

/// Appends `next` to `marking`, which keeps its id and has the status of the longer one. The gap between them
/// is bridged straight; its style is unknown.
void append(Marking& marking, const Marking& next);

}  // namespace laneloom
