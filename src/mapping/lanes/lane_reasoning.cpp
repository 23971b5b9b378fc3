#include "mapping/lanes/lane_reasoning.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "mapping/lanes/lane_evidence.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kSamePlace_m = 1.5;  ///< between the middles of two lanes that lie in one place

using Verdict = LaneReason::Verdict;

double mean_log_odds(const std::vector<LaneStation>& stations) {
  double sum = 0.0;
  for (const LaneStation& station : stations) sum += station.log_odds;
  return stations.empty() ? 0.0 : sum / static_cast<double>(stations.size());
}

/// The boundaries that the borders lie on, in their order along the lane.
std::vector<ElementId> boundaries_on(Side side, const std::vector<LaneStation>& stations) {
  std::vector<ElementId> ids;
  for (const LaneStation& station : stations) {
    const ElementId id = station.boundary[index(side)];
    if (id != kNoElement && std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
  }
  return ids;
}

/// The lane that lies where another one lay. kNoElement: there is none.
ElementId lane_at(const std::vector<Point>& places, const std::vector<LaneTrack>& tracks) {
  const Point& middle = places[places.size() / 2];
  for (const LaneTrack& track : tracks)
    for (const LaneStation& station : track.stations)
      if ((station.center() - middle).head<2>().norm() < kSamePlace_m) return track.id;
  return kNoElement;
}

}  // namespace

LaneReasoning::LaneReasoning(FrameReasons* to, const std::vector<LaneTrack>& tracks) : to_(to) {
  if (to_ == nullptr) return;
  to_->lanes.clear();
  to_->show_lane = kShown;
  to_->hide_lane = kHidden;
  for (const LaneTrack& track : tracks) {
    Before& before = before_[track.id];
    for (const LaneStation& station : track.stations) before.places.push_back(station.center());
    before.reason = {.id = track.id,
                     .log_odds = mean_log_odds(track.stations),
                     .left = boundaries_on(Side::left, track.stations),
                     .right = boundaries_on(Side::right, track.stations)};
  }
}

void LaneReasoning::observed(const LaneTrack& track, const std::vector<Match>& matches) {
  if (to_ == nullptr) return;
  LaneReason& reason = lanes_[track.id];
  reason = before_[track.id].reason;
  reason.gained = mean_log_odds(track.stations) - reason.log_odds;
  reason.log_odds += reason.gained;
  reason.observed = matches.size();
  for (const Match& match : matches) {
    if (match.strip)
      ++reason.found;
    else if (match.is_taken)
      ++reason.taken;
    else if (match.is_denied)
      ++reason.denied;
  }
}

void LaneReasoning::decided(const LaneTrack& track, const std::optional<Lane>& lane) {
  if (to_ == nullptr) return;
  LaneReason& reason = lanes_[track.id];
  reason.id = track.id;
  reason.log_odds = mean_log_odds(track.stations);
  reason.left = boundaries_on(Side::left, track.stations);
  reason.right = boundaries_on(Side::right, track.stations);
  reason.places = track.stations.size();
  for (const LaneStation& station : track.stations) {
    if (!station.shown) continue;
    ++reason.shown;
    if (station.status == ElementStatus::confirmed) ++reason.confirmed;
    if (station.status == ElementStatus::inferred) ++reason.inferred;
  }
  reason.verdict = lane ? Verdict::shown : reason.shown > 0 ? Verdict::too_short : Verdict::weak;
  before_.erase(track.id);
}

void LaneReasoning::ended(const std::vector<LaneTrack>& tracks, const geometry::MapBox& box) {
  if (to_ == nullptr) return;
  for (const auto& [id, before] : before_) {
    LaneReason& reason = lanes_[id];
    const bool kept = std::ranges::any_of(before.places, [&](const Point& at) { return box.keeps(at); });
    reason.other = kept ? lane_at(before.places, tracks) : kNoElement;
    reason.verdict = !kept ? Verdict::passed : reason.other != kNoElement ? Verdict::replaced : Verdict::lost;
  }
  for (auto& [id, reason] : lanes_) to_->lanes.push_back(std::move(reason));
}

}  // namespace laneloom::lanes
