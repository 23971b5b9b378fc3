#pragma once

#include <cstddef>
#include <vector>

namespace laneloom::geometry {

/// Groups of elements that belong together. Within a group it is known which elements run against each other.
class OrientedGroups {
 public:
  explicit OrientedGroups(std::size_t count);

  /// Makes one group of the groups of `a` and `b`. If they are in one group already, nothing changes,
  /// whatever `opposed` says.
  void join(std::size_t a, std::size_t b, bool opposed);

  /// The group of an element, named by the smallest index in it.
  std::size_t group(std::size_t element) const { return group_[element]; }
  /// Whether two elements of one group run against each other.
  bool opposed(std::size_t a, std::size_t b) const { return opposed_[a] != opposed_[b]; }

 private:
  std::vector<std::size_t> group_;
  std::vector<bool> opposed_;  ///< only whether two members of a group differ matters
};

}  // namespace laneloom::geometry
