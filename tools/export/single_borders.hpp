#pragma once

#include "laneloom/types.hpp"

namespace laneloom::exports {

/// The same map with lanes that have one border on each side. A lane is cut where a border begins; its parts
/// are linked. A border that is unseen becomes an inferred boundary along the lane's side. The first part
/// keeps the lane's id. Neighbours are left out.
LocalMap with_single_borders(LocalMap map);

}  // namespace laneloom::exports
