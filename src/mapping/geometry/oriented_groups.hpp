#pragma once

#include <cstddef>
#include <vector>

namespace laneloom {

/// Which of some elements belong together, and which run against each other there.
class OrientedGroups {
 public:
  explicit OrientedGroups(std::size_t count);

  /// The groups of `a` and `b` become one. Where they are one already, what is known of their directions
  /// stays.
  void join(std::size_t a, std::size_t b, bool opposed);

  /// The smallest index of the element's group.
  std::size_t group(std::size_t element) const { return group_[element]; }
  /// Whether two of one group run against each other.
  bool opposed(std::size_t a, std::size_t b) const { return opposed_[a] != opposed_[b]; }

 private:
  std::vector<std::size_t> group_;
  std::vector<bool> opposed_;  ///< to the other members, as a whole either way
};

}  // namespace laneloom
