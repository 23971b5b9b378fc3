#include "mapping/topology/directions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/oriented_groups.hpp"
#include "mapping/geometry/reproducible.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/markings/markings.hpp"
#include "mapping/topology/side_by_side.hpp"
#include "mapping/topology/stoplines.hpp"

namespace laneloom::topology {
namespace {

// Log odds that a lane runs along its centerline.
constexpr double kEgoEvidence = 0.5;       // per frame
constexpr double kStoplineEvidence = 0.3;  // per frame
constexpr double kMemory = 0.98;  // factor per frame beside the lane, where the vehicle may have overtaken
constexpr double kMaxEvidence = 6.0;
constexpr double kEdgeEvidence = 1.0;      // of an edge beside the outermost lane
constexpr double kEdgeLineEvidence = 0.5;  // of a solid line beside the outermost lane
// Of the first trail in a lane; the n-th one counts 1/n² of it.
constexpr double kTrailEvidence = 1.5;
constexpr double kOncomingEvidence =
    3.0;  // beside the own way and against it: nobody drives there by mistake
constexpr double kOvertakingEvidence = 0.5;  // beside the own way and along it
constexpr double kCosDriven = 0.8660254;     // 30 degrees; a vehicle at a wider angle crosses the lane
constexpr double kOneWayEvidence = 2.0;      // of a one-way street of the SD map
constexpr double kWrongSide = -6.0;          // for traffic that keeps to the wrong side
constexpr double kWrongObserved = -4.0;      // likewise, where traffic told the side
constexpr double kOwnWay = 2.0;              // from here on, the lane is known to be the own way's
constexpr double kTells = 0.05;              // a term that is less tells nothing
constexpr double kRemembered = 0.5;          // of a belief, beyond what the frame says
constexpr double kKnown = 1.5;               // from here on, a direction is published
constexpr double kNews = 0.05;               // share of a frame in the belief in a direction
constexpr double kGrowth = 0.3;              // likewise, where the frame says more than the belief
constexpr double kDoubted = 0.5;             // below, a direction is published no longer

constexpr int kRounds = 12;  // of messages: more than there are lanes side by side

/// The end of a lane at which stoplines lie. 1: its end; -1: its start; 0: neither or both.
double stopline_sense(const Lane& lane, const std::vector<Marking>& markings, const StoplineConfig& config) {
  double sense = 0.0;
  for (const Marking& marking : markings) {
    if (marking.type != MarkingType::stopline) continue;
    if (crosses_end(marking, lane, End::back, config)) sense += 1.0;
    if (crosses_end(marking, lane, End::front, config)) sense -= 1.0;
  }
  return std::clamp(sense, -1.0, 1.0);
}

/// Groups lanes that continue one another, or lie along the same side of one boundary. A group is one
/// variable of the model.
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
        // Where a lane for turning opens in the middle of a road, it has the boundary beside it that had the
        // oncoming lane beside it before.
        if (!lanes::are_neighbours(lanes[first.lane], lanes[i]))
          groups.join(first.lane, i, side.reversed != first.reversed);
      }
    }
  }
  for (const Linkage& linkage : road.linkages)
    groups.join(index.at(linkage.from), index.at(linkage.to), false);
  return groups;
}

/// Whether a lane runs against the first one of its group.
bool is_opposed(const geometry::OrientedGroups& groups, std::size_t lane) {
  return groups.opposed(lane, groups.group(lane));
}

struct Mean {
  double sum = 0.0;
  int count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  double value() const { return count == 0 ? 0.0 : sum / count; }
};

/// Two groups side by side.
struct SideBySideGroups {
  std::size_t left, right;
  double opposed;                        ///< log odds that they run against each other
  bool may_part;                         ///< they may belong to two roads
  double to_left = 0.0, to_right = 0.0;  ///< messages of belief propagation
};

/// Log odds are per group, that it runs along its first lane.
struct Model {
  std::vector<double> drive, borders, trails, streets;  ///< the terms of the evidence
  std::vector<double> evidence;                         ///< their sum
  std::vector<SideBySideGroups> pairs;
};

/// The driving side as a sign. 1: traffic keeps right; -1: it keeps left; 0: it is not known.
double driving_side(const DirectionConfig& config) {
  if (config.driving_side == DrivingSide::unknown) return 0.0;
  return config.driving_side == DrivingSide::right ? 1.0 : -1.0;
}

/// Log odds by the outer border of a road that the lane beside it runs along its centerline, if traffic keeps
/// to that side.
double border_evidence(const Marking& border, const Stretch& range) {
  if (border.status == ElementStatus::inferred) return 0.0;
  if (border.type == MarkingType::roadedge) return kEdgeEvidence;
  return markings::dashed_excess_m(border, range) < 0.0 ? kEdgeLineEvidence : 0.0;
}

/// Per lane, the log odds of its direction by the borders of the road, if traffic keeps right.
std::vector<double> outermost_evidence(const lanes::LaneLayout& layout,
                                       const std::vector<SideBySideLanes>& pairs) {
  const std::vector<Lane>& lanes = layout.lanes;
  std::vector<bool> open_left(lanes.size(), true), open_right(lanes.size(), true);
  for (const SideBySideLanes& pair : pairs) open_right[pair.left] = open_left[pair.right] = false;
  const auto evidence_of = [&](const Lane& lane, Side side) {
    if (goes_on_beyond(layout, lane, side)) return 0.0;
    return lanes::mean_over(lane.borders(side), [&](const Border& border) {
      return border_evidence(layout.boundaries.of(border.boundary).marking, border.on_boundary);
    });
  };
  std::vector<double> evidence(lanes.size(), 0.0);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Lane& lane = lanes[i];
    if (open_right[i] && lane.right_neighbours.empty()) evidence[i] += evidence_of(lane, Side::right);
    if (open_left[i] && lane.left_neighbours.empty()) evidence[i] -= evidence_of(lane, Side::left);
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
  for (double& one : observed) one = std::clamp(one, -kMaxEvidence, kMaxEvidence);
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
    const bool is_own = std::abs(drive[group]) >= kOwnWay;
    if (!is_own && std::abs(drive[other]) >= kOwnWay) beside[group] = drive[other];
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

/// Per group, the log odds of its direction by the trails in its lanes. A trail counts once, as it was mostly
/// driven. `driven` is in the order of the trails. `beside` is as own_way_beside() tells.
std::vector<double> traffic_evidence(const std::vector<DrivenStretch>& driven,
                                     const geometry::OrientedGroups& groups,
                                     const std::vector<double>& beside) {
  std::vector<double> evidence(beside.size(), 0.0), along_m(beside.size(), 0.0);
  std::vector<std::array<int, 2>> trails(beside.size());  // that were driven along and against
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
  return evidence;
}

Model build_model(const lanes::LaneLayout& layout, const geometry::OrientedGroups& groups,
                  const RoadTraffic& traffic, const lanes::LaneTracks& tracks, double side) {
  const std::vector<Lane>& lanes = layout.lanes;
  const std::vector<double> outermost = outermost_evidence(layout, traffic.beside);
  Model model{.drive = remembered_evidence(lanes, groups, tracks),
              .borders = {},
              .trails = {},
              .streets = {},
              .evidence = {},
              .pairs = side_by_side_groups(traffic.beside, groups)};
  model.trails = traffic_evidence(traffic.driven, groups, own_way_beside(model.drive, model.pairs));
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

/// Per group, the log odds of its direction in the most likely solution (max-product). Only maxima and sums
/// are computed, so that the result is the same to the last bit on every host.
std::vector<double> beliefs(double side, double wrong_side, Model& model) {
  std::vector<double> belief = model.evidence;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> next = model.evidence;
    for (SideBySideGroups& pair : model.pairs) {
      // `meeting`: the left group runs against its first lane and the right one along its own, as right-hand
      // traffic meets. `parting`: the reverse.
      const double wrong = pair.may_part ? std::min(0.0, pair.opposed) : wrong_side;
      const double meeting = side < 0.0 ? wrong : pair.opposed;
      const double parting = side > 0.0 ? wrong : pair.opposed;
      const double left = belief[pair.left] - pair.to_left, right = belief[pair.right] - pair.to_right;
      pair.to_right = std::max(meeting, left) - std::max(0.0, left + parting);
      pair.to_left = std::max(parting, right) - std::max(0.0, right + meeting);
      next[pair.right] += pair.to_right;
      next[pair.left] += pair.to_left;
    }
    belief = std::move(next);
  }
  return belief;
}

/// What the last map told of the lanes of each group, in the sense of its first lane.
struct Told {
  std::vector<Mean> belief;         ///< in a direction
  std::vector<double> direction;    ///< sum of the directions that were told
  std::vector<double> orientation;  ///< metres of lanes that ran along the first one, less those against it
};

Told told(const std::vector<Lane>& lanes, const geometry::OrientedGroups& groups,
          const lanes::LaneTracks& tracks) {
  Told told{std::vector<Mean>(lanes.size()), std::vector<double>(lanes.size(), 0.0),
            std::vector<double>(lanes.size(), 0.0)};
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const lanes::LaneTrack* known = tracks.find(lanes[i].id);
    if (known == nullptr || known->published == 0) continue;
    const double sense = is_opposed(groups, i) ? -1.0 : 1.0;
    told.belief[groups.group(i)].add(sense * known->belief);
    told.direction[groups.group(i)] += sense * known->told_direction;
    told.orientation[groups.group(i)] += sense * known->published * length(lanes[i].centerline);
  }
  return told;
}

/// A belief that follows the log odds of each frame: quickly where they grow, slowly where they fall, since
/// lanes and borders that tell a direction come and go.
double followed(double belief, double log_odds) {
  const bool grows = belief * log_odds >= 0.0 && std::abs(log_odds) > std::abs(belief);
  return belief + (grows ? kGrowth : kNews) * (log_odds - belief);
}

/// Whether a direction of these log odds is published. `told` has the sign of the one that the last map told.
bool is_known(double log_odds, double told) {
  return std::abs(log_odds) >= (log_odds * told > 0.0 ? kDoubted : kKnown);
}

/// The sense in which the lanes of a group are published, with respect to its first lane: as traffic runs; if
/// that is not known, as they ran in the last map; else as traffic rather runs, or as the first lane.
double sense_of(double log_odds, double told_direction, double told_orientation) {
  const double as_traffic = log_odds < 0.0 ? -1.0 : 1.0;
  if (is_known(log_odds, told_direction)) return as_traffic;
  if (told_orientation != 0.0) return told_orientation;
  return std::abs(log_odds) >= kDoubted ? as_traffic : 1.0;
}

/// The lanes are told that the vehicle or others drove in them.
void note_driven(const std::vector<DrivenStretch>& driven, const lanes::LaneTracks& tracks,
                 std::vector<Lane>& lanes) {
  for (const DrivenStretch& stretch : driven)
    if (std::abs(stretch.along_m) >= kMinDriven_m) lanes[stretch.lane].evidence |= Evidence::traffic;
  for (Lane& lane : lanes)
    if (const lanes::LaneTrack* known = tracks.find(lane.id); known != nullptr && known->driven)
      lane.evidence |= Evidence::ego_path;
}

/// Per group, what tells its direction in this frame: terms of its own, and those of the groups beside that
/// count for it. Where traffic told the driving side, all that the side decides rests on traffic.
std::vector<Evidence> evidence_of(const Model& model, const geometry::OrientedGroups& groups,
                                  const std::vector<Lane>& lanes, const RoadTraffic& traffic) {
  const std::size_t count = lanes.size();
  std::vector<Evidence> borders(count, Evidence::none), evidence(count, Evidence::none);
  std::vector<bool> driven(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    borders[groups.group(i)] |= lanes[i].evidence & (Evidence::markings | Evidence::edges);
    if (overlap(lanes[i].evidence, Evidence::ego_path)) driven[groups.group(i)] = true;
  }
  const auto tells = [](double log_odds) { return std::abs(log_odds) >= kTells; };
  const Evidence by_side = traffic.is_side_corrected ? Evidence::traffic : Evidence::none;
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

/// What a belief rests on: what tells it now and, as long as it is more than that, what told it before.
Evidence followed(const lanes::LaneTrack& track, Evidence now, double belief, double frame) {
  const bool explained =
      std::abs(belief) <= kRemembered || belief * frame >= belief * belief - kRemembered * std::abs(belief);
  return explained ? now : now | track.belief_evidence;
}

/// The sense in which the vehicle drives along a lane. 0: it is elsewhere, or crosses the lane on its way
/// into another road.
double driven_sense(const Lane& lane, const Eigen::Isometry3d& T_map_body) {
  const double along = ego_alignment(lane, T_map_body);
  return std::abs(along) < kCosDriven ? 0.0 : std::copysign(1.0, along);
}

/// The place for the reasons of a lane. Null: nobody asks.
LaneReason* reason_of(ElementId id, FrameReasons* reasons) {
  if (reasons == nullptr) return nullptr;
  const auto found = std::ranges::find(reasons->lanes, id, &LaneReason::id);
  return found == reasons->lanes.end() ? nullptr : &*found;
}

/// Log odds of a group's direction.
struct GroupBelief {
  double frame = 0.0;     ///< by this frame
  double followed = 0.0;  ///< smoothed over frames
};

/// Notes the terms of a lane's direction, in the sense in which it is published.
void explain(const Model& model, std::size_t group, double sense, const GroupBelief& belief,
             LaneReason& reason) {
  reason.by_drive = sense * model.drive[group];
  reason.by_borders = sense * model.borders[group];
  reason.by_trails = sense * model.trails[group];
  reason.by_streets = sense * model.streets[group];
  reason.by_beside = sense * (belief.frame - model.evidence[group]);
  reason.direction = sense * belief.followed;
}

}  // namespace

void observe_directions(const std::vector<Lane>& lanes, const Eigen::Isometry3d& T_map_body,
                        const std::vector<Marking>& markings, const StoplineConfig& config,
                        lanes::LaneTracks& tracks) {
  const auto driven =
      std::ranges::find_if(lanes, [&](const Lane& lane) { return driven_sense(lane, T_map_body) != 0.0; });
  for (const Lane& lane : lanes) {
    lanes::LaneTrack* remembered = tracks.find(lane.id);
    if (remembered == nullptr) continue;
    double& log_odds = remembered->direction_log_odds;
    if (driven != lanes.end() && lanes::are_neighbours(*driven, lane)) log_odds *= kMemory;
    const double sense = driven_sense(lane, T_map_body);
    remembered->driven = remembered->driven || sense != 0.0;
    log_odds += kEgoEvidence * sense + kStoplineEvidence * stopline_sense(lane, markings, config);
    log_odds = std::clamp(log_odds, -kMaxEvidence, kMaxEvidence);
  }
}

void find_directions(const DirectionConfig& config, const RoadTraffic& traffic, lanes::LaneTracks& tracks,
                     RoadGraph& road, FrameReasons* reasons) {
  const geometry::OrientedGroups groups = group(road);
  const double side = driving_side(config);
  Model model = build_model(road, groups, traffic, tracks, side);
  const std::vector<double> now =
      beliefs(side, traffic.is_side_corrected ? kWrongObserved : kWrongSide, model);
  std::vector<double> belief = now;
  const Told before = told(road.lanes, groups, tracks);
  for (std::size_t i = 0; i < belief.size(); ++i)
    if (before.belief[i].count > 0) belief[i] = followed(before.belief[i].value(), belief[i]);
  note_driven(traffic.driven, tracks, road.lanes);
  const std::vector<Evidence> evidence = evidence_of(model, groups, road.lanes, traffic);
  std::vector<ElementId> against;
  for (std::size_t i = 0; i < road.lanes.size(); ++i) {
    Lane& lane = road.lanes[i];
    const std::size_t of = groups.group(i);
    const double sense = is_opposed(groups, i) ? -1.0 : 1.0;
    Evidence rests_on = evidence[of];
    if (lanes::LaneTrack* track = tracks.find(lane.id)) {
      track->belief = sense * belief[of];
      rests_on = track->belief_evidence = followed(*track, rests_on, belief[of], now[of]);
    }
    if (is_known(belief[of], before.direction[of])) {
      lane.direction = Lane::Direction::along_centerline;
      lane.direction_probability = geometry::reproducible::probability(std::abs(belief[of]));
      lane.direction_evidence = rests_on == Evidence::none ? lane.evidence : rests_on;
    }
    const bool turns = sense * sense_of(belief[of], before.direction[of], before.orientation[of]) < 0.0;
    if (turns) against.push_back(lane.id);
    if (LaneReason* reason = reason_of(lane.id, reasons))
      explain(model, of, turns ? -sense : sense, {.frame = now[of], .followed = belief[of]}, *reason);
  }
  road.turn(against);
  for (Linkage& linkage : road.linkages)
    linkage.turn = turn_between(road.lane(linkage.from), road.lane(linkage.to));
}

}  // namespace laneloom::topology
