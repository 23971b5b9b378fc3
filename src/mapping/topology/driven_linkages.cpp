#include "mapping/topology/driven_linkages.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::topology {
namespace {

constexpr double kAtEnd_m = 5.0;      // from the end of a lane, where a trail leaves it
constexpr double kMinInLane_m = 2.0;  // of a trail in either lane

struct Claim {
  Linkage::Kind kind;
  Evidence evidence;
  double probability;
};

Claim claim_of(Driver driver) {
  if (driver == Driver::ego) return {Linkage::Kind::ego_track, Evidence::ego_path, 0.95};
  return {Linkage::Kind::traffic, Evidence::traffic, 0.9};
}

Linkage linkage_between(const Lane& from, const Lane& to, const Claim& claim) {
  const Linkage::Turn turn = turn_between(from, to);
  const bool straight = turn == Linkage::Turn::straight;
  return {.from = from.id,
          .to = to.id,
          .kind = claim.kind,
          .turn = turn,
          .probability = claim.probability,
          .evidence = claim.evidence,
          .path = straight ? lanes::path_ahead(from, to) : lanes::path_between(from, to)};
}

/// Whether a kind of linkage is a guess, or what others did.
bool is_doubtful(Linkage::Kind kind) {
  return kind == Linkage::Kind::intersection || kind == Linkage::Kind::traffic;
}

bool is_near(const Point& a, const Point& b) { return (a - b).head<2>().norm() <= kAtEnd_m; }

/// Whether a trail goes on without a gap from one of its points to another.
bool goes_on(const Polyline& trail, std::size_t from, std::size_t to) {
  for (std::size_t k = from; k < to; ++k)
    if ((trail[k + 1] - trail[k]).head<2>().norm() > trails::kMaxGap_m) return false;
  return true;
}

/// The step that a trail makes from one of its stretches to the next.
std::optional<LaneStep> step_between(const Polyline& trail, const DrivenStretch& left,
                                     const DrivenStretch& entered, const std::vector<Lane>& lanes) {
  const Lane &from = lanes[left.lane], &to = lanes[entered.lane];
  if (left.lane == entered.lane || !is_step(from, to)) return std::nullopt;
  if (std::min(std::abs(left.along_m), std::abs(entered.along_m)) < kMinInLane_m) return std::nullopt;
  if (!is_near(trail[left.last], from.centerline.back()) ||
      !is_near(trail[entered.first], to.centerline.front()))
    return std::nullopt;
  // The lanes may have been turned round since the stretches were found.
  const std::size_t out = left.last - 1, in = entered.first;
  if (trails::direction_at(trail, out).dot(lanes::leaving(from)) < kCosInLane ||
      trails::direction_at(trail, in).dot(lanes::entering(to)) < kCosInLane)
    return std::nullopt;
  return goes_on(trail, out, in) ? std::optional(LaneStep(from.id, to.id)) : std::nullopt;
}

}  // namespace

bool is_step(const Lane& from, const Lane& to) {
  return !lanes::are_neighbours(from, to) &&
         lanes::gap_between(from, to).dot(lanes::leaving(from)) > -lanes::kMaxOverlap_m;
}

void link_driven(const std::vector<LaneStep>& steps, Driver driver, RoadGraph& road) {
  const Claim claim = claim_of(driver);
  for (const LaneStep& step : steps) {
    const auto known = std::ranges::find_if(
        road.linkages, [&](const Linkage& linkage) { return LaneStep(linkage.from, linkage.to) == step; });
    if (known == road.linkages.end()) {
      road.linkages.push_back(linkage_between(road.lane(step.first), road.lane(step.second), claim));
      continue;
    }
    known->evidence |= claim.evidence;
    if (!is_doubtful(known->kind) || known->probability > claim.probability) continue;
    known->kind = claim.kind;
    known->probability = claim.probability;
  }
  road.sort_linkages();
}

void link_traffic(const std::vector<trails::Trail>& trails, const std::vector<DrivenStretch>& driven,
                  RoadGraph& road) {
  std::vector<LaneStep> steps;
  for (std::size_t i = 1; i < driven.size(); ++i) {
    if (driven[i - 1].trail != driven[i].trail) continue;
    const auto step = step_between(trails[driven[i].trail].points, driven[i - 1], driven[i], road.lanes);
    if (step && std::ranges::count(steps, *step) == 0) steps.push_back(*step);
  }
  if (!steps.empty()) link_driven(steps, Driver::other, road);
}

}  // namespace laneloom::topology
