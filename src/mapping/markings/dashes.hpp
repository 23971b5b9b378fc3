#pragma once

#include <vector>

#include "mapping/markings/preprocess.hpp"

namespace laneloom::markings {

/// Joins lanelines that lie in a row, because some networks show each painted dash by itself. Of two
/// neighbours in a row, at least one is as short as a dash. A row becomes one laneline that runs through the
/// gaps. It is dashed if it has three dashes or one of its pieces is said to be dashed.
///
/// The doubt of a row, 1 minus its belief, is the product of its pieces' doubts: false detections do not
/// lie in rows, so a row is wrong only if all of its pieces are. A laneline that is in no row, and each
/// marking of another type, stays unchanged.
std::vector<ObservedMarking> join_dashes(std::vector<ObservedMarking> markings);

}  // namespace laneloom::markings
