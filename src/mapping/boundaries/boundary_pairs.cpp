#include "mapping/boundaries/boundary_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace laneloom {
namespace {

constexpr std::size_t kMaxBetween = 1;      // boundaries: (b_i, b_i+1) and (b_i, b_i+2) of the paper
constexpr std::size_t kTooManyBetween = 7;  // for a pair of any kind
constexpr double kMinBetween = 0.15;        // of the stretch; a shorter boundary only touches it
constexpr double kMinBesideEdge = 0.5;      // of that line

/// How many boundaries lie between one and another beside it.
struct CountBetween {
  std::size_t all = 0;
  std::size_t lasting = 0;  ///< those that are beside both over much of the stretch
};

CountBetween between(const SectionGraph& graph, std::size_t one, const SideBySide& other) {
  const auto& beyond = graph.beside[other.other];
  const bool one_on_left = other.opposed == other.on_left();  // of the other
  CountBetween count;
  for (const SideBySide& middle : graph.beside[one]) {
    if (count.lasting >= kTooManyBetween) break;
    if (middle.on_left() != other.on_left()) continue;
    const auto found = std::ranges::find(beyond, middle.other, &SideBySide::other);
    if (found == beyond.end() || found->on_left() != one_on_left) continue;
    ++count.all;
    if (std::min(middle.length_m, found->length_m) >= kMinBetween * other.length_m) ++count.lasting;
  }
  return count;
}

/// Whether the road ends at a boundary's right side, at its left side: it is an edge, or has one along it
/// there.
std::vector<std::array<bool, 2>> kerb_sides(const SectionGraph& graph,
                                            const std::vector<LaneBoundary>& boundaries,
                                            const std::vector<MeasuredPolyline>& measured) {
  const auto is_edge = [&](std::size_t i) { return boundaries[i].marking.type == MarkingType::roadedge; };
  std::vector<std::array<bool, 2>> kerbs(boundaries.size());
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    for (const bool left : {false, true}) {
      kerbs[i][left] = is_edge(i) || std::ranges::any_of(graph.beside[i], [&](const SideBySide& beside) {
                         return is_edge(beside.other) && beside.on_left() == left &&
                                std::abs(beside.lateral_m) < kAlongEdge_m &&
                                beside.length_m >= kMinBesideEdge * measured[i].length();
                       });
    }
  }
  return kerbs;
}

}  // namespace

std::vector<BoundaryPair> boundary_pairs(const SectionGraph& graph,
                                         const std::vector<LaneBoundary>& boundaries,
                                         const std::vector<MeasuredPolyline>& measured) {
  const auto is_line = [&](std::size_t i) { return boundaries[i].marking.type != MarkingType::roadedge; };
  const auto kerbs = kerb_sides(graph, boundaries, measured);
  // Those with nothing between, then those with what only touches either.
  std::array<std::vector<BoundaryPair>, 3> by_rank;
  for (std::uint32_t section = 0; section < graph.sections.size(); ++section) {
    for (const std::size_t one : graph.sections[section].boundaries) {
      for (const SideBySide& other : graph.beside[one]) {
        if (other.opposed ? other.other < one : other.on_left()) continue;
        const auto [all, lasting] = between(graph, one, other);
        if (lasting >= kTooManyBetween) continue;
        BoundaryPair pair{.left = one,
                          .right = other.other,
                          .right_reversed = other.opposed,
                          .adjacent = lasting == 0,
                          .near = lasting <= kMaxBetween,
                          .section = section};
        if (other.on_left()) {
          std::swap(pair.left, pair.right);
          std::swap(pair.left_reversed, pair.right_reversed);
        }
        pair.left_kerb = kerbs[pair.left][!pair.left_reversed];
        pair.right_kerb = kerbs[pair.right][pair.right_reversed];
        pair.crosses_kerb = (is_line(pair.left) && kerbs[pair.left][pair.left_reversed]) ||
                            (is_line(pair.right) && kerbs[pair.right][!pair.right_reversed]);
        by_rank[lasting > 0 ? 2 : std::min<std::size_t>(all, 1)].push_back(pair);
      }
    }
  }
  std::vector<BoundaryPair> result;
  for (const auto& group : by_rank) result.insert(result.end(), group.begin(), group.end());
  return result;
}

}  // namespace laneloom
