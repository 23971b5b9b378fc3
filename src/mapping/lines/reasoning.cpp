#include "mapping/lines/reasoning.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "mapping/lines/line_evidence.hpp"
#include "mapping/lines/line_publishing.hpp"

namespace laneloom::lines {
namespace {

using Rule = DetectionFate::Rule;
using Verdict = LineReason::Verdict;

double mean_log_odds(const Line& line) { return existence(line.stations, {}); }

double distance_m(const Point& point, const SampledDetection& detection) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Point& sample : detection.samples)
    least_m = std::min(least_m, (sample - point).head<2>().norm());
  return least_m;
}

/// The detection that a dash is part of: the nearest one.
const SampledDetection* row_of(const markings::ObservedMarking& dash,
                               const std::vector<SampledDetection>& detections) {
  const auto nearest = std::ranges::min_element(detections, {}, [&](const SampledDetection& detection) {
    return distance_m(dash.points.front(), detection);
  });
  return nearest == detections.end() ? nullptr : &*nearest;
}

}  // namespace

Reasoning::Reasoning(FrameReasons* to, const markings::ObservedFrame& observed,
                     const std::vector<Line>& lines)
    : to_(to) {
  if (to_ == nullptr) return;
  *to_ = {.stamp_ns = observed.frame.stamp_ns};
  to_->detections.resize(observed.frame.detections.size(), {.rule = Rule::zigzag});
  for (const markings::ObservedMarking& marking : observed.markings)
    to_->detections[marking.number].rule = Rule::unsure;
  for (const Line& line : lines) {
    Before& before = before_[line.id] = {.type = line.type(), .log_odds = mean_log_odds(line)};
    for (const Station& station : line.stations) before.places.push_back(station.position);
  }
}

void Reasoning::believed(const std::vector<markings::ObservedMarking>& markings) {
  if (to_ == nullptr) return;
  believed_ = markings;
  for (const markings::ObservedMarking& marking : markings)
    to_->detections[marking.number].rule = Rule::unused;
}

void Reasoning::associated(const Association& association, const std::vector<Line>& lines) {
  if (to_ == nullptr) return;
  for (const LineMatch& match : association.matches) {
    const std::size_t number = association.detections[match.detection].number;
    DetectionFate& fate = to_->detections[number];
    fate.rule = Rule::observes;
    fate.lines.push_back(lines[match.line].id);
    of(lines[match.line]).detections.push_back(number);
  }
  // Dashes of one row were joined to one detection, which has the number of one of them.
  for (const markings::ObservedMarking& marking : believed_) {
    const auto is_same = [&](const SampledDetection& detection) {
      return detection.number == marking.number;
    };
    if (std::ranges::any_of(association.detections, is_same)) continue;
    const SampledDetection* row = row_of(marking, association.detections);
    if (row == nullptr) continue;
    DetectionFate& fate = to_->detections[marking.number] = to_->detections[row->number];
    fate.in_row = to_->detections[row->number].in_row = true;
    for (const ElementId line : fate.lines) lines_[line].detections.push_back(marking.number);
  }
}

void Reasoning::updated(const std::vector<Line>& lines, const FusionConfig& config) {
  if (to_ == nullptr) return;
  to_->publish = config.publish_log_odds;
  to_->confirm = config.confirm_log_odds;
  for (const Line& line : lines) {
    LineReason& reason = of(line);
    reason.gained = mean_log_odds(line) - before_[line.id].log_odds;
    reason.places = line.stations.size();
    for (const Station& station : line.stations) {
      if (station.sight == Sight::observed) ++reason.observed;
      if (station.sight == Sight::missed) ++reason.missed;
    }
  }
}

void Reasoning::born(const Line& line, const std::vector<SampledDetection>& detections) {
  if (to_ == nullptr) return;
  const auto is_its_first = [&](const SampledDetection& detection) {
    return distance_m(line.stations.front().position, detection) == 0.0;
  };
  const auto detection = std::ranges::find_if(detections, is_its_first);
  LineReason& reason = of(line);
  reason.places = reason.observed = line.stations.size();
  if (detection == detections.end()) return;
  DetectionFate& fate = to_->detections[detection->number];
  if (fate.rule == Rule::unused) fate.rule = Rule::begins;
  fate.lines.push_back(line.id);
  reason.detections.push_back(detection->number);
}

void Reasoning::decided(const std::vector<Line>& lines, const markings::PairHistories& doubles,
                        const std::vector<Marking>& published, const MapperConfig& config) {
  if (to_ == nullptr) return;
  const std::vector<Shadow> held_back = shadows(lines, doubles, config.fusion);
  for (const Line& line : lines) {
    LineReason& reason = of(line);
    reason.by_stations = mean_log_odds(line);
    reason.by_belief = log_odds(line.beliefs);
    const auto marking = std::ranges::find(published, line.id, &Marking::id);
    const auto shadow = std::ranges::find(held_back, line.id, &Shadow::line);
    if (marking != published.end()) {
      const bool confirmed = marking->status == ElementStatus::confirmed;
      reason.verdict = confirmed ? Verdict::confirmed : Verdict::tentative;
    } else if (shadow != held_back.end()) {
      reason.verdict = Verdict::held_back;
      reason.other = shadow->of;
    } else {
      const bool weak = reason.by_stations + reason.by_belief < config.fusion.publish_log_odds;
      reason.verdict = weak ? Verdict::weak : Verdict::too_short;
    }
    before_.erase(line.id);
  }
}

void Reasoning::ended(const std::vector<markings::Relative>& relatives, const geometry::MapBox& box) {
  if (to_ == nullptr) return;
  for (const auto& [id, before] : before_) {
    LineReason& reason = lines_[id];
    reason.id = id;
    reason.type = before.type;
    reason.by_stations = before.log_odds + reason.gained;
    const auto merged = std::ranges::find(relatives, id, &markings::Relative::id);
    const bool kept =
        std::ranges::any_of(before.places, [&](const Point& place) { return box.keeps(place); });
    reason.verdict = merged != relatives.end() ? Verdict::merged : kept ? Verdict::lost : Verdict::passed;
    if (merged != relatives.end()) reason.other = merged->other;
  }
  for (auto& [id, reason] : lines_) to_->lines.push_back(std::move(reason));
}

LineReason& Reasoning::of(const Line& line) {
  LineReason& reason = lines_[line.id];
  reason.id = line.id;
  reason.type = line.type();
  return reason;
}

}  // namespace laneloom::lines
