#pragma once

#include <vector>

#include "mapping/markings/preprocess.hpp"

namespace laneloom {

/// Joins what lies in a row, where a network shows each painted dash by itself: lanelines with gaps between
/// them, of two neighbours at least one as short as a dash. A row becomes one laneline that runs through the
/// gaps, and a dashed one if it has three dashes or one of its pieces is said to be dashed.
///
/// The row is wrong only if all of its pieces are: ghosts do not lie in rows. Its doubt (1 - confidence) is
/// the product of theirs. A laneline that is joined with nothing, and each line of another type, stays as it
/// is.
std::vector<ObservedMarking> join_dashes(std::vector<ObservedMarking> markings);

}  // namespace laneloom
