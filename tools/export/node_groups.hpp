#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include "export/gates.hpp"

namespace laneloom::exports {

/// Groups of cuts that are one node. Two cuts of one boundary never are.
class NodeGroups {
 public:
  explicit NodeGroups(const std::vector<Gates::Cut>& cuts) : cuts_(cuts) {}

  std::size_t group(std::size_t cut) {
    grow();
    while (parent_[cut] != cut) cut = parent_[cut] = parent_[parent_[cut]];
    return cut;
  }
  /// Whether two cuts may become one node.
  bool may_join(std::size_t a, std::size_t b) {
    if (group(a) == group(b)) return true;
    const std::set<std::size_t>&of_a = boundaries_[group(a)], &of_b = boundaries_[group(b)];
    return std::ranges::none_of(of_a, [&](std::size_t boundary) { return of_b.contains(boundary); });
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t from = group(a), to = group(b);
    if (from == to) return;
    parent_[from] = to;
    boundaries_[to].merge(boundaries_[from]);
  }

 private:
  /// Takes in the cuts that were made since.
  void grow() {
    for (std::size_t cut = parent_.size(); cut < cuts_.size(); ++cut) {
      parent_.push_back(cut);
      boundaries_.push_back({cuts_[cut].boundary});
    }
  }

  const std::vector<Gates::Cut>& cuts_;
  std::vector<std::size_t> parent_;
  std::vector<std::set<std::size_t>> boundaries_;
};

}  // namespace laneloom::exports
