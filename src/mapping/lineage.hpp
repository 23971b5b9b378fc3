#pragma once

#include <utility>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom {

/// The published element that each marking is part of: pairs of (marking, element), by ascending marking.
using Membership = std::vector<std::pair<ElementId, ElementId>>;

/// The membership of boundaries, each with its members, and of stoplines, each of which is its own member.
Membership membership(const boundaries::Boundaries& boundaries, const std::vector<Stopline>& stoplines);

/// The events of published ids from one map to the next, by ascending id. `relatives` are the lines that
/// merged or were split in between.
std::vector<LineageEvent> lineage(const Membership& before, const Membership& now,
                                  const std::vector<markings::Relative>& relatives);

/// Marks the events of stoplines as such.
void mark_stoplines(const std::vector<Stopline>& stoplines, std::vector<LineageEvent>& events);

/// The events of lanes from one map to the next, by ascending id. A new lane is split from the lane beside
/// whose former centerline half of it or more lies. A lane that is gone merged into the lane that lies beside
/// half of it or more.
std::vector<LineageEvent> lane_lineage(const std::vector<Lane>& before, const std::vector<Lane>& now);

}  // namespace laneloom
