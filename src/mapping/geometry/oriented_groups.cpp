#include "mapping/geometry/oriented_groups.hpp"

#include <algorithm>
#include <numeric>

namespace laneloom::geometry {

OrientedGroups::OrientedGroups(std::size_t count) : group_(count), opposed_(count, false) {
  std::iota(group_.begin(), group_.end(), 0U);
}

void OrientedGroups::join(std::size_t a, std::size_t b, bool opposed) {
  if (group_[a] == group_[b]) return;
  const bool turn = opposed_[a] != (opposed_[b] != opposed);
  const auto [kept, gone] = std::minmax({group_[a], group_[b]});
  for (std::size_t k = 0; k < group_.size(); ++k) {
    if (group_[k] != gone) continue;
    group_[k] = kept;
    opposed_[k] = opposed_[k] != turn;
  }
}

}  // namespace laneloom::geometry
