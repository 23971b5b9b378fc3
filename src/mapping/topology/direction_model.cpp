#include "mapping/topology/direction_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/markings/markings.hpp"
#include "mapping/topology/linkages.hpp"
#include "mapping/topology/side_by_side.hpp"

namespace laneloom::topology {
namespace {

// Log odds that a lane runs along its centerline.
constexpr double kEdgeEvidence = 1.0;      // of an edge beside the outermost lane
constexpr double kIslandEvidence = 3.0;    // of a round island beside the lane
constexpr double kEdgeLineEvidence = 0.5;  // of a solid line beside the outermost lane
// The first trail in a lane counts so much, and the n-th one 1/n² of it. A trail beside the own way tells
// more if it runs against it, because nobody drives there by mistake, and less if it runs along it.
constexpr double kTrailEvidence = 1.5;
constexpr double kOncomingEvidence = 3.0;
constexpr double kOvertakingEvidence = 0.5;
constexpr int kLeastOfBoth = 3;          // vehicles, the own one among them, that tell of traffic both ways
constexpr double kOneWayEvidence = 2.0;  // of a one-way street of the SD map
constexpr double kWrongSide = -6.0;      // for traffic that keeps to the wrong side
constexpr double kWrongObserved = -4.0;  // likewise, where traffic told the side
constexpr double kTells = 0.05;          // a term that is less tells nothing

constexpr int kRounds = 12;  // of messages: more than there are lanes side by side

/// Groups lanes that continue one another, or lie along the same side of one boundary.
geometry::OrientedGroups group(const RoadGraph& road) {
  const std::vector<Lane>& lanes = road.lanes;
  struct First {
    std::size_t lane;
    bool reversed;  ///< the boundary runs against the lane
  };
  geometry::OrientedGroups groups(lanes.size());
  std::map<ElementId, std::size_t> index;
  std::map<std::pair<lanes::BoundarySide, std::size_t>, First> beside;  // by stretches between forks
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    index.emplace(lanes[i].id, i);
    for (const Side one : kSides) {
      for (const Border& border : lanes[i].borders(one)) {
        if (border.boundary == kNoElement) continue;
        const lanes::LaneSide side = lanes::lane_side(border, one);
        const First& first =
            beside.emplace(std::pair(side.of, lanes::forks_before(side, road.forks)), First{i, side.reversed})
                .first->second;
        // A lane for turning that opens in the middle of a road has the boundary beside it that the oncoming
        // lane had before.
        const Lane& other = lanes[first.lane];
        if (!lanes::are_neighbours(other, lanes[i]) && !leads_elsewhere(other, lanes[i], road) &&
            !leads_elsewhere(lanes[i], other, road))
          groups.join(first.lane, i, side.reversed != first.reversed);
      }
    }
  }
  for (const Linkage& linkage : road.linkages)
    groups.join(index.at(linkage.from), index.at(linkage.to), false);
  return groups;
}

/// 1: traffic keeps right; -1: it keeps left; 0: it is not known.
double side_sign(DrivingSide side) {
  if (side == DrivingSide::unknown) return 0.0;
  return side == DrivingSide::right ? 1.0 : -1.0;
}

/// Log odds by the outer border of a road that the lane beside it runs along its centerline, if traffic keeps
/// to that side.
double border_evidence(const Marking& border, const Stretch& range) {
  if (border.status == ElementStatus::inferred) return 0.0;
  if (border.type == MarkingType::roadedge) return kEdgeEvidence;
  return markings::dashed_excess_m(border, range) < 0.0 ? kEdgeLineEvidence : 0.0;
}

/// Per lane, the log odds of its direction by the borders of the road, if traffic keeps right.
std::vector<double> outermost_evidence(const lanes::LaneLayout& layout, const RoadTraffic& traffic) {
  const std::vector<Lane>& lanes = layout.lanes;
  std::vector<bool> open_left(lanes.size(), true), open_right(lanes.size(), true);
  for (const SideBySideLanes& pair : traffic.beside) open_right[pair.left] = open_left[pair.right] = false;
  const auto evidence_of = [&](const Lane& lane, Side side) {
    if (goes_on_beyond(layout, lane, side, traffic.own_way)) return 0.0;
    return lanes::mean_over(lane.borders(side), [&](const Border& border) {
      return border_evidence(layout.boundaries.of(border.boundary).marking, border.on_boundary);
    });
  };
  std::vector<double> evidence(lanes.size(), 0.0);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Lane& lane = lanes[i];
    if (open_right[i] && lane.right_neighbours.empty()) evidence[i] += evidence_of(lane, Side::right);
    if (open_left[i] && lane.left_neighbours.empty()) evidence[i] -= evidence_of(lane, Side::left);
    if (layout.goes_round(lane, Side::left)) evidence[i] += kIslandEvidence;
    if (layout.goes_round(lane, Side::right)) evidence[i] -= kIslandEvidence;
  }
  return evidence;
}

/// Per group, the log odds of its direction by what was observed of it so far.
std::vector<double> remembered_evidence(const std::vector<Lane>& lanes,
                                        const geometry::OrientedGroups& groups,
                                        const lanes::LaneTracks& tracks) {
  std::vector<double> observed(lanes.size(), 0.0);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const lanes::LaneTrack* remembered = tracks.find(lanes[i].id);
    if (remembered == nullptr) continue;
    const int sense = is_opposed(groups, i) ? -1 : 1;
    observed[groups.group(i)] += sense * remembered->direction_log_odds;
  }
  for (double& one : observed) one = std::clamp(one, -kMaxObserved, kMaxObserved);
  return observed;
}

std::vector<SideBySideGroups> side_by_side_groups(const std::vector<SideBySideLanes>& beside,
                                                  const geometry::OrientedGroups& groups) {
  struct Sum {
    Mean opposed;
    bool may_part = true;
  };
  std::map<std::pair<std::size_t, std::size_t>, Sum> sums;
  for (const SideBySideLanes& pair : beside) {
    const std::size_t left = groups.group(pair.left), right = groups.group(pair.right);
    const bool turned = is_opposed(groups, pair.left);
    if (left == right || turned != is_opposed(groups, pair.right)) continue;
    Sum& sum = sums[turned ? std::pair(right, left) : std::pair(left, right)];
    sum.opposed.add(pair.opposed);
    sum.may_part = sum.may_part && pair.may_part;
  }
  std::vector<SideBySideGroups> pairs;
  pairs.reserve(sums.size());
  for (const auto& [pair, sum] : sums)
    pairs.push_back({pair.first, pair.second, sum.opposed.value(), sum.may_part});
  return pairs;
}

/// Per group, the log odds that the vehicle drove along the group beside it; 0: it is not known to have
/// driven beside this one.
std::vector<double> own_way_beside(const std::vector<double>& drive,
                                   const std::vector<SideBySideGroups>& pairs) {
  std::vector<double> beside(drive.size(), 0.0);
  const auto note = [&](std::size_t group, std::size_t other) {
    const bool is_own = std::abs(drive[group]) >= kOwnDriveKnown;
    if (!is_own && std::abs(drive[other]) >= kOwnDriveKnown) beside[group] = drive[other];
  };
  for (const SideBySideGroups& pair : pairs) {
    if (pair.may_part) continue;
    note(pair.left, pair.right);
    note(pair.right, pair.left);
  }
  return beside;
}

/// The log odds of a trail, by how far it was driven along a group and by the own way beside.
double trail_evidence(double along_m, double own_way_beside) {
  if (own_way_beside == 0.0) return kTrailEvidence;
  return along_m * own_way_beside < 0.0 ? kOncomingEvidence : kOvertakingEvidence;
}

/// The evidence of the trails in the lanes of groups.
struct GroupTraffic {
  std::vector<double> evidence;            ///< per group, log odds of its direction
  std::vector<std::array<int, 2>> trails;  ///< per group, number of those that were driven along and against
};

/// A trail counts once, as it was mostly driven. `driven` is in the order of the trails. `beside` is as
/// own_way_beside() tells.
GroupTraffic traffic_evidence(const std::vector<DrivenStretch>& driven,
                              const geometry::OrientedGroups& groups, const std::vector<double>& beside) {
  std::vector<double> evidence(beside.size(), 0.0), along_m(beside.size(), 0.0);
  std::vector<std::array<int, 2>> trails(beside.size());
  for (auto first = driven.begin(); first != driven.end();) {
    const auto end = std::find_if(first, driven.end(),
                                  [&](const DrivenStretch& one) { return one.trail != first->trail; });
    for (auto stretch = first; stretch != end; ++stretch)
      along_m[groups.group(stretch->lane)] +=
          is_opposed(groups, stretch->lane) ? -stretch->along_m : stretch->along_m;
    for (; first != end; ++first) {
      const std::size_t group = groups.group(first->lane);
      const double length_m = std::exchange(along_m[group], 0.0);
      if (std::abs(length_m) < kMinDriven_m) continue;
      const int number = ++trails[group][length_m > 0.0 ? 0 : 1];
      evidence[group] += std::copysign(trail_evidence(length_m, beside[group]) / (number * number), length_m);
    }
  }
  return {std::move(evidence), std::move(trails)};
}

/// Per group, the log odds that its lane is driven both ways, 0 where nothing tells it. It is the only lane
/// of its road: elsewhere, whoever drives against the others overtakes.
std::vector<double> both_ways_evidence(const std::vector<double>& drive,
                                       const std::vector<SideBySideGroups>& pairs,
                                       const std::vector<std::array<int, 2>>& trails) {
  std::vector<double> evidence(drive.size(), 0.0);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const auto is_pair = [&](const SideBySideGroups& pair) { return pair.left == i || pair.right == i; };
    const int along = trails[i][0] + (drive[i] >= kOwnDriveKnown ? 1 : 0);
    const int against = trails[i][1] + (drive[i] <= -kOwnDriveKnown ? 1 : 0);
    if (along + against < kLeastOfBoth || std::ranges::any_of(pairs, is_pair)) continue;
    evidence[i] = kTrailEvidence * std::min(along, against);
  }
  return evidence;
}

}  // namespace

bool is_opposed(const geometry::OrientedGroups& groups, std::size_t lane) {
  return groups.opposed(lane, groups.group(lane));
}

DirectionModel direction_model(const RoadGraph& road, DrivingSide driving_side, const RoadTraffic& traffic,
                               const lanes::LaneTracks& tracks) {
  const std::vector<Lane>& lanes = road.lanes;
  const geometry::OrientedGroups groups = group(road);
  const double side = side_sign(driving_side);
  const std::vector<double> outermost = outermost_evidence(road, traffic);
  DirectionModel model{.groups = groups,
                       .side = side,
                       .is_side_corrected = traffic.is_side_corrected,
                       .drive = remembered_evidence(lanes, groups, tracks),
                       .borders = {},
                       .trails = {},
                       .streets = {},
                       .evidence = {},
                       .both_ways = {},
                       .pairs = side_by_side_groups(traffic.beside, groups)};
  GroupTraffic others = traffic_evidence(traffic.driven, groups, own_way_beside(model.drive, model.pairs));
  model.trails = std::move(others.evidence);
  model.both_ways = both_ways_evidence(model.drive, model.pairs, others.trails);
  std::vector<Mean> borders(lanes.size()), streets(lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const double sense = is_opposed(groups, i) ? -1.0 : 1.0;
    borders[groups.group(i)].add(sense * side * outermost[i]);
    if (!traffic.one_way.empty()) streets[groups.group(i)].add(sense * kOneWayEvidence * traffic.one_way[i]);
  }
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    model.borders.push_back(borders[i].value());
    model.streets.push_back(streets[i].value());
    model.evidence.push_back(model.drive[i] + (model.borders[i] + model.trails[i] + model.streets[i]));
  }
  return model;
}

std::vector<double> solve(DirectionModel& model) {
  const double wrong_side = model.is_side_corrected ? kWrongObserved : kWrongSide;
  std::vector<double> belief = model.evidence, next;
  for (int round = 0; round < kRounds; ++round) {
    next = model.evidence;
    for (SideBySideGroups& pair : model.pairs) {
      // `meeting`: the left group runs against its first lane and the right one along its own, as right-hand
      // traffic meets. `parting`: the reverse.
      const double wrong = pair.may_part ? std::min(0.0, pair.opposed) : wrong_side;
      const double meeting = model.side < 0.0 ? wrong : pair.opposed;
      const double parting = model.side > 0.0 ? wrong : pair.opposed;
      const double left = belief[pair.left] - pair.to_left, right = belief[pair.right] - pair.to_right;
      pair.to_right = std::max(meeting, left) - std::max(0.0, left + parting);
      pair.to_left = std::max(parting, right) - std::max(0.0, right + meeting);
      next[pair.right] += pair.to_right;
      next[pair.left] += pair.to_left;
    }
    std::swap(belief, next);
  }
  return belief;
}

std::vector<Evidence> evidence_of(const DirectionModel& model, const std::vector<Lane>& lanes) {
  const geometry::OrientedGroups& groups = model.groups;
  const std::size_t count = lanes.size();
  std::vector<Evidence> borders(count, Evidence::none), evidence(count, Evidence::none);
  std::vector<bool> driven(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    borders[groups.group(i)] |= lanes[i].evidence & (Evidence::markings | Evidence::edges);
    if (overlap(lanes[i].evidence, Evidence::ego_path)) driven[groups.group(i)] = true;
  }
  const auto tells = [](double log_odds) { return std::abs(log_odds) >= kTells; };
  const Evidence by_side = model.is_side_corrected ? Evidence::traffic : Evidence::none;
  for (std::size_t i = 0; i < count; ++i) {
    if (tells(model.drive[i])) evidence[i] |= driven[i] ? Evidence::ego_path : Evidence::markings;
    if (tells(model.borders[i])) evidence[i] |= borders[i] | by_side;
    if (tells(model.trails[i])) evidence[i] |= Evidence::traffic;
    if (tells(model.streets[i])) evidence[i] |= Evidence::sd_map;
  }
  const auto spread = [&](double message, std::size_t from, std::size_t to) {
    if (tells(message)) evidence[to] |= evidence[from] | borders[to] | by_side;
  };
  for (int round = 0; round < kRounds; ++round)
    for (const SideBySideGroups& pair : model.pairs) {
      spread(pair.to_left, pair.right, pair.left);
      spread(pair.to_right, pair.left, pair.right);
    }
  return evidence;
}

}  // namespace laneloom::topology
