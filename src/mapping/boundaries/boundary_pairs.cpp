#include "mapping/boundaries/boundary_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace laneloom::boundaries {
namespace {

constexpr std::size_t kMaxBetween = 1;  // boundaries: (b_i, b_i+1) and (b_i, b_i+2) of the paper
constexpr double kMinBetween = 0.15;    // share of the pair's stretch; a shorter boundary only touches it

/// Numbers of boundaries that lie between one boundary and another beside it.
struct CountBetween {
  std::size_t all = 0;
  std::size_t lasting = 0;  ///< number of those that lie beside both over much of the stretch
};

CountBetween count_between(const SectionGraph& graph, std::size_t one, const SideBySide& other) {
  const auto& beyond = graph.beside[other.other];
  const Side of_one = other.opposed ? other.side() : opposite(other.side());  // as the other runs
  CountBetween count;
  for (const SideBySide& middle : graph.beside[one]) {
    if (count.lasting > kMaxBetween) break;
    if (middle.side() != other.side()) continue;
    const auto found = std::ranges::find(beyond, middle.other, &SideBySide::other);
    if (found == beyond.end() || found->side() != of_one) continue;
    ++count.all;
    if (std::min(middle.length_m, found->length_m) >= kMinBetween * other.length_m) ++count.lasting;
  }
  return count;
}

BoundaryPair pair_of(std::size_t one, const SideBySide& other, std::uint32_t section) {
  BoundaryPair pair{.left = one, .right = other.other, .right_reversed = other.opposed, .section = section};
  if (other.side() == Side::left) {
    std::swap(pair.left, pair.right);
    std::swap(pair.left_reversed, pair.right_reversed);
  }
  return pair;
}

}  // namespace

std::vector<BoundaryPair> boundary_pairs(const SectionGraph& graph) {
  // Pairs with nothing between, then pairs with boundaries between that only touch them, then all others.
  std::array<std::vector<BoundaryPair>, 3> by_rank;
  for (std::uint32_t section = 0; section < graph.sections.size(); ++section) {
    for (const std::size_t one : graph.sections[section].boundaries) {
      for (const SideBySide& other : graph.beside[one]) {
        if (other.opposed ? other.other < one : other.side() == Side::left) continue;
        const auto [all, lasting] = count_between(graph, one, other);
        if (lasting > kMaxBetween) continue;
        by_rank[lasting > 0 ? 2 : std::min<std::size_t>(all, 1)].push_back(pair_of(one, other, section));
      }
    }
  }
  std::vector<BoundaryPair> result;
  for (const auto& group : by_rank) result.insert(result.end(), group.begin(), group.end());
  return result;
}

}  // namespace laneloom::boundaries
