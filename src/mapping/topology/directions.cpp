#include "mapping/topology/directions.hpp"

#include <algorithm>
#include <cmath>

#include "laneloom/lane_graph.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/geometry/reproducible.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/topology/direction_model.hpp"
#include "mapping/topology/stoplines.hpp"

namespace laneloom::topology {
namespace {

// Log odds that a lane runs along its centerline.
constexpr double kEgoEvidence = 0.5;       // per frame
constexpr double kWellWithin = 0.35;       // of a lane's width, from its centerline
constexpr double kStoplineEvidence = 0.3;  // per frame
constexpr double kMemory = 0.98;     // factor per frame beside the lane, where the vehicle may have overtaken
constexpr double kKnown = 1.5;       // from here on, a direction is published
constexpr double kNews = 0.05;       // share of a frame in the belief in a direction
constexpr double kGrowth = 0.3;      // likewise, where the frame says more than the belief does
constexpr double kDoubted = 0.5;     // below, a direction is published no longer
constexpr double kRemembered = 0.5;  // of a belief, beyond what the frame says

double limited(double log_odds) { return std::clamp(log_odds, -kMaxObserved, kMaxObserved); }

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

/// Whether the vehicle is so near a border of a lane, beyond which no lane is known, that it may drive in one
/// there.
bool may_drive_beyond(const Lane& lane, const Eigen::Isometry3d& T_map_body) {
  const auto foot = foot_in(lane, T_map_body.translation());
  return foot && foot->distance_m > kWellWithin * lane.width_m &&
         neighbours(lane, foot->lateral_m > 0.0 ? Side::left : Side::right).empty();
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

/// A belief that follows the log odds of each frame: quickly where they say more than the belief, slowly
/// where they say less, since lanes and borders that tell a direction come and go.
double followed(double belief, double log_odds) {
  const bool says_more = std::abs(log_odds) > std::abs(belief);
  return belief + (says_more ? kGrowth : kNews) * (log_odds - belief);
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

/// Log odds of a group's direction.
struct GroupBelief {
  double frame = 0.0;     ///< by this frame
  double followed = 0.0;  ///< smoothed over frames
};

/// What a belief rests on: what tells it now and, as long as it is more than that, what told it before.
Evidence remembered(const lanes::LaneTrack& track, Evidence now, const GroupBelief& belief) {
  const double beyond = std::abs(belief.followed) - std::copysign(1.0, belief.followed) * belief.frame;
  return beyond > kRemembered ? now | track.belief_evidence : now;
}

void tell(Lane::Direction direction, double log_odds, Evidence evidence, Lane& lane) {
  lane.direction = direction;
  lane.direction_probability = geometry::reproducible::probability(std::abs(log_odds));
  lane.direction_evidence = evidence;
}

/// The place for the reasons of a lane. Null: nobody asks.
LaneReason* reason_of(ElementId id, FrameReasons* reasons) {
  if (reasons == nullptr) return nullptr;
  const auto found = std::ranges::find(reasons->lanes, id, &LaneReason::id);
  return found == reasons->lanes.end() ? nullptr : &*found;
}

/// Notes the terms of a lane's direction, in the sense in which it is published.
void explain(const DirectionModel& model, std::size_t group, double sense, const GroupBelief& belief,
             LaneReason& reason) {
  reason.by_drive = sense * model.drive[group];
  reason.by_borders = sense * model.borders[group];
  reason.by_trails = sense * model.trails[group];
  reason.by_streets = sense * model.streets[group];
  reason.by_beside = sense * (belief.frame - model.evidence[group]);
  reason.direction = sense * belief.followed;
}

}  // namespace

void observe_drive(const std::vector<Lane>& lanes, const Eigen::Isometry3d& T_map_body,
                   lanes::LaneTracks& tracks) {
  std::vector<double> senses;  // in which the vehicle drives in each lane
  senses.reserve(lanes.size());
  for (const Lane& lane : lanes) senses.push_back(lanes::ego_sense(lane, T_map_body, kCosInLane));
  const auto driven = static_cast<std::size_t>(
      std::ranges::find_if(senses, [](double sense) { return sense != 0.0; }) - senses.begin());
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Lane& lane = lanes[i];
    const double sense = senses[i];
    const bool is_beside = driven < lanes.size() && lanes::are_neighbours(lanes[driven], lane);
    lanes::LaneTrack* remembered = sense != 0.0 || is_beside ? tracks.find(lane.id) : nullptr;
    if (remembered == nullptr) continue;
    double& log_odds = remembered->direction_log_odds;
    if (is_beside) log_odds *= kMemory;
    remembered->driven = remembered->driven || sense != 0.0;
    if (sense != 0.0 && !may_drive_beyond(lane, T_map_body))
      log_odds = limited(log_odds + kEgoEvidence * sense);
  }
}

void observe_stoplines(const std::vector<Lane>& lanes, const std::vector<Marking>& markings,
                       const StoplineConfig& config, lanes::LaneTracks& tracks) {
  for (const Lane& lane : lanes) {
    const double sense = stopline_sense(lane, markings, config);
    lanes::LaneTrack* remembered = sense != 0.0 ? tracks.find(lane.id) : nullptr;
    if (remembered == nullptr) continue;
    double& log_odds = remembered->direction_log_odds;
    log_odds = limited(log_odds + kStoplineEvidence * sense);
  }
}

void find_directions(const DirectionConfig& config, const RoadTraffic& traffic, lanes::LaneTracks& tracks,
                     RoadGraph& road, FrameReasons* reasons) {
  DirectionModel model = direction_model(road, config.driving_side, traffic, tracks);
  const geometry::OrientedGroups& groups = model.groups;
  const std::vector<double> now = solve(model);
  std::vector<double> belief = now;
  const Told before = told(road.lanes, groups, tracks);
  for (std::size_t i = 0; i < belief.size(); ++i)
    if (before.belief[i].count > 0) belief[i] = followed(before.belief[i].value(), belief[i]);
  note_driven(traffic.driven, tracks, road.lanes);
  const std::vector<Evidence> evidence = evidence_of(model, road.lanes);
  std::vector<ElementId> against;
  for (std::size_t i = 0; i < road.lanes.size(); ++i) {
    Lane& lane = road.lanes[i];
    const std::size_t of = groups.group(i);
    const double sense = is_opposed(groups, i) ? -1.0 : 1.0;
    const GroupBelief of_group{.frame = now[of], .followed = belief[of]};
    Evidence rests_on = evidence[of];
    if (lanes::LaneTrack* track = tracks.find(lane.id)) {
      track->belief = sense * belief[of];
      rests_on = track->belief_evidence = remembered(*track, rests_on, of_group);
    }
    if (is_known(belief[of], before.direction[of]))
      tell(Lane::Direction::along_centerline, belief[of],
           rests_on == Evidence::none ? lane.evidence : rests_on, lane);
    if (model.both_ways[of] > 0.0)
      tell(Lane::Direction::both, model.both_ways[of],
           lane.evidence & (Evidence::traffic | Evidence::ego_path), lane);
    const bool turns = sense * sense_of(belief[of], before.direction[of], before.orientation[of]) < 0.0;
    if (turns) against.push_back(lane.id);
    if (LaneReason* reason = reason_of(lane.id, reasons))
      explain(model, of, turns ? -sense : sense, of_group, *reason);
  }
  road.turn(against);
  for (Linkage& linkage : road.linkages)
    linkage.turn = turn_between(road.lane(linkage.from), road.lane(linkage.to));
}

}  // namespace laneloom::topology
