#include "mapping/lines/line_mapper.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "mapping/lines/driven_over.hpp"
#include "mapping/lines/frame_pitch.hpp"
#include "mapping/lines/joints.hpp"
#include "mapping/lines/line_evidence.hpp"
#include "mapping/lines/line_fusion.hpp"
#include "mapping/lines/line_growth.hpp"
#include "mapping/lines/line_joining.hpp"
#include "mapping/lines/line_merging.hpp"
#include "mapping/lines/line_publishing.hpp"
#include "mapping/lines/line_room.hpp"
#include "mapping/lines/reasoning.hpp"
#include "mapping/markings/dashes.hpp"

namespace laneloom::lines {
namespace {

constexpr double kLever_m = 15.0;     // what a turn weighs, in metres
constexpr double kAwayNews = 0.02;    // weight of a new frame in the variance of how far frames lie away
constexpr double kLeastAway_m = 0.1;  // a frame that is less away lies as usual
constexpr double kUnusual = 3.0;      // standard deviations

Viewpoint viewpoint(const markings::ObservedFrame& observed, std::size_t source, Network& network) {
  return {.T_map_body = observed.T_map_body,
          .stamp_ns = observed.frame.stamp_ns,
          .source = static_cast<std::uint32_t>(source),
          .news = network.standpoint.news(observed.T_map_body.translation(), observed.frame.stamp_ns),
          .gains = network.lateral.gains()};
}

/// Tells how far each detection is believed, and keeps those that are sure enough. Returns the number of the
/// others.
std::size_t believe(const DetectionModel& model, const PreprocessConfig& config,
                    std::vector<markings::ObservedMarking>& markings) {
  for (markings::ObservedMarking& marking : markings) marking.belief = model.belief(marking.confidence);
  return drop_unsure(config, markings);
}

/// Forgets the views of a source that is forgotten, and whose number another one has now.
void forget_views_of(std::size_t source, std::vector<Line>& lines) {
  for (Line& line : lines)
    for (Station& station : line.stations)
      for (FarView& view : station.far_views)
        if (view.source == source) view = {};
}

}  // namespace

markings::FusedMarkings LineMapper::fuse(markings::ObservedFrame observed, const geometry::Scene& scene,
                                         const MapperConfig& config, markings::IdSource& ids,
                                         const markings::StageLog& log) {
  const FusionConfig& fusion = config.fusion;
  const bool is_new = networks_.find(observed.frame.source) == nullptr;
  const std::size_t source = networks_.number(observed.frame.source, scene.frame, config);
  if (is_new) forget_views_of(source, lines_);
  Network& network = networks_[source];
  Viewpoint from = viewpoint(observed, source, network);
  Reasoning reasons(log.reasons(), observed, lines_);
  const std::size_t unsure = believe(network.detection, config.preprocess, observed.markings);
  reasons.believed(observed.markings);
  Association association = associated(std::move(observed.markings), network, fusion, from);
  reasons.associated(association, lines_);
  count_joints(association.matches, lines_, config.boundary.max_gap_m, joints_);
  log.done(Stage::association);

  fuse_matches(association, from, fusion, networks_, lines_);
  const View view(observed.T_map_body.inverse(), observed.frame, from.news, network.standpoint.least_news());
  credit_observed(view, association, fusion, network.detection, lines_);
  discount_unobserved(view, scene.box, fusion, network.detection, lines_);
  reasons.updated(lines_, fusion);
  log.done(Stage::line_update);

  extend_lines(from, scene.box, fusion, association, lines_);
  for (Line& line : new_lines(association.detections, from, scene.box, fusion, network.detection)) {
    line.id = ids.next();
    line.first_seen_ns = line.last_seen_ns = observed.frame.stamp_ns;
    reasons.born(line, association.detections);
    lines_.push_back(std::move(line));
  }
  forgotten_ = keep_within_room(lines_);
  deny_driven_over(scene.driven, lines_);
  std::vector<markings::Relative> relatives = unite(fusion, view.is_independent());
  std::ranges::copy(prune_lines(scene.box, fusion, lines_, ids), std::back_inserter(relatives));
  log.done(Stage::line_set);

  markings::FusedMarkings fused{publish_lines(lines_, doubles_, config), joints_, std::move(relatives),
                                unsure};
  reasons.decided(lines_, doubles_, fused.markings, config);
  reasons.ended(fused.relatives, scene.box);
  return log.done(Stage::polylines, std::move(fused));
}

/// Samples the detections, takes the suspected pitch and pose error of the frame out of them, and matches
/// them with the lines. Notes the suspected errors in `from`.
Association LineMapper::associated(std::vector<markings::ObservedMarking> markings, Network& network,
                                   const FusionConfig& config, Viewpoint& from) {
  const Eigen::Isometry3d& T_map_body = from.T_map_body;
  auto detections = sample_detections(join_dashes(std::move(markings)), config);
  from.stretch = network.pitch.parts(estimate_stretch_per_m(detections, T_map_body));
  unstretch(from.gains[kSuddenPitch] * from.stretch.sudden_per_m +
                from.gains[kLastingPitch] * from.stretch.lasting_per_m,
            T_map_body, detections);
  LineMatcher matcher(lines_, config);
  const FrameErrors errors = align_frame(T_map_body, from.gains[kPose], matcher, detections, lasting_error_);
  from.error = errors.likely;
  away_m_ = std::abs(errors.away.y()) + kLever_m * std::abs(errors.away.z());
  away_variance_m2_ += kAwayNews * (away_m_ * away_m_ - away_variance_m2_);
  weigh(network.lateral, T_map_body.translation(), detections);
  return associate(matcher, std::move(detections));
}

/// Merges lines and, if `joins`, joins them. What is known of a line that is gone is known of the line that
/// it is part of now.
std::vector<markings::Relative> LineMapper::unite(const FusionConfig& config, bool joins) {
  StationGrid grid = station_grid(lines_);
  std::vector<markings::Relative> relatives = merge_doubles(config, grid, lines_, doubles_);
  if (!joins) return relatives;
  if (!relatives.empty()) grid = station_grid(lines_);
  for (const auto& [stays, end, gone, gone_end] :
       join_lines(config, joints_, std::move(grid), lines_, overlaps_)) {
    relatives.push_back({gone, stays});
    rename(gone, stays, doubles_);
    for (markings::PairHistories* const ends : {&joints_, &overlaps_}) {
      forget(markings::end_id(stays, end), *ends);
      forget(markings::end_id(gone, gone_end), *ends);
      rename(markings::end_id(gone, opposite(gone_end)), markings::end_id(stays, end), *ends);
    }
  }
  return relatives;
}

bool LineMapper::has_seen(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) const {
  const Network* network = networks_.find(frame.source);
  return network != nullptr && network->standpoint.has_seen(T_map_body.translation(), frame.stamp_ns);
}

bool LineMapper::is_away() const {
  return away_m_ > std::max(kLeastAway_m, kUnusual * std::sqrt(away_variance_m2_));
}

void LineMapper::reset() {
  Networks networks = std::move(networks_);
  *this = {};
  networks_ = std::move(networks);
  networks_.forget_places();
}

void LineMapper::move(const Eigen::Isometry3d& motion) {
  for (Line& line : lines_)
    for (Station& station : line.stations) {
      station.position = motion * station.position;
      station.lateral.move(motion);
    }
  networks_.move(motion);
}

}  // namespace laneloom::lines
