#include "mapping/boundaries/boundary_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace laneloom::boundaries {
namespace {

constexpr std::size_t kMaxBetween = 1;      // of a near pair: (b_i, b_i+1) and (b_i, b_i+2) of the paper
constexpr std::size_t kTooManyBetween = 7;  // boundaries, for a pair of any kind
constexpr double kMinBetween = 0.15;        // share of the pair's stretch; a shorter boundary only touches it
constexpr double kMinBesideEdge = 0.5;      // share of a line that lies along an edge

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
    if (count.lasting >= kTooManyBetween) break;
    if (middle.side() != other.side()) continue;
    const auto found = std::ranges::find(beyond, middle.other, &SideBySide::other);
    if (found == beyond.end() || found->side() != of_one) continue;
    ++count.all;
    if (std::min(middle.length_m, found->length_m) >= kMinBetween * other.length_m) ++count.lasting;
  }
  return count;
}

/// The sides of boundaries at which the road ends: of edges both sides, of a line the side on which an edge
/// runs along it.
class KerbSides {
 public:
  explicit KerbSides(const SectionGraph& graph) : kerbs_(graph.boundaries.size()) {
    for (std::size_t i = 0; i < kerbs_.size(); ++i)
      for (const Side side : kSides) kerbs_[i][index(side)] = is_kerb(graph, i, side);
  }
  bool at(std::size_t boundary, Side side) const { return kerbs_[boundary][index(side)]; }

 private:
  static bool is_kerb(const SectionGraph& graph, std::size_t i, Side side) {
    return graph.boundaries[i].is_edge() ||
           std::ranges::any_of(graph.beside[i], [&](const SideBySide& beside) {
             return graph.boundaries[beside.other].is_edge() && beside.side() == side &&
                    std::abs(beside.lateral_m) < kAlongEdge_m &&
                    beside.length_m >= kMinBesideEdge * graph.boundaries[i].course.length();
           });
  }

  std::vector<std::array<bool, 2>> kerbs_;
};

BoundaryPair pair_of(std::size_t one, const SideBySide& other, const SectionGraph& graph,
                     const KerbSides& kerbs) {
  BoundaryPair pair{.left = one, .right = other.other, .right_reversed = other.opposed};
  if (other.side() == Side::left) {
    std::swap(pair.left, pair.right);
    std::swap(pair.left_reversed, pair.right_reversed);
  }
  const auto is_kerb = [&](Side border, Side side) {
    return kerbs.at(pair.index(border), as_seen(side, pair.reversed(border)));
  };
  const auto is_line = [&](std::size_t i) { return !graph.boundaries[i].is_edge(); };
  pair.left_kerb = is_kerb(Side::left, Side::left);
  pair.right_kerb = is_kerb(Side::right, Side::right);
  pair.crosses_kerb = (is_line(pair.left) && is_kerb(Side::left, Side::right)) ||
                      (is_line(pair.right) && is_kerb(Side::right, Side::left));
  return pair;
}

}  // namespace

std::vector<BoundaryPair> boundary_pairs(const SectionGraph& graph) {
  const KerbSides kerbs(graph);
  // Pairs with nothing between, then pairs with boundaries between that only touch them, then all others.
  std::array<std::vector<BoundaryPair>, 3> by_rank;
  for (std::uint32_t section = 0; section < graph.sections.size(); ++section) {
    for (const std::size_t one : graph.sections[section].boundaries) {
      for (const SideBySide& other : graph.beside[one]) {
        if (other.opposed ? other.other < one : other.side() == Side::left) continue;
        const auto [all, lasting] = count_between(graph, one, other);
        if (lasting >= kTooManyBetween) continue;
        BoundaryPair pair = pair_of(one, other, graph, kerbs);
        pair.adjacent = lasting == 0;
        pair.near = lasting <= kMaxBetween;
        pair.section = section;
        by_rank[lasting > 0 ? 2 : std::min<std::size_t>(all, 1)].push_back(pair);
      }
    }
  }
  std::vector<BoundaryPair> result;
  for (const auto& group : by_rank) result.insert(result.end(), group.begin(), group.end());
  return result;
}

}  // namespace laneloom::boundaries
