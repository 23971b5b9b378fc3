#include <algorithm>

#include "evaluation/map_evaluation.hpp"

namespace laneloom::evaluation {
namespace {

void add(const Stability& from, Stability& to) {
  to.jitter_m.add(from.jitter_m);
  to.id_switches += from.id_switches;
  to.has_ids = to.has_ids || from.has_ids;
  to.driven_past_m += from.driven_past_m;
  to.was_right += from.was_right;
  to.lost += from.lost;
}

void add(const Trust& from, Trust& to) {
  to.vertices += from.vertices;
  to.vertices_within_2_sigma += from.vertices_within_2_sigma;
  for (std::size_t i = 0; i < kCalibrationBins; ++i) {
    to.calibration[i].count += from.calibration[i].count;
    to.calibration[i].confidences += from.calibration[i].confidences;
    to.calibration[i].right += from.calibration[i].right;
  }
  to.first_appearance_s.add(from.first_appearance_s);
  to.first_appearance_m.add(from.first_appearance_m);
  to.never_appeared += from.never_appeared;
}

void add(const PairScore& from, PairScore& to) {
  to.published += from.published;
  to.right += from.right;
  to.truths += from.truths;
  to.found += from.found;
}

}  // namespace

Stability Measures::markings_stability() const {
  Stability all;
  for (const MarkingType type : kMarkingTypes) add(stability[index(line_kind(type))], all);
  return all;
}

Measures& Measures::operator+=(const Measures& other) {
  for (std::size_t i = 0; i < kLineKindCount; ++i) {
    score.by_kind[i] += other.score.by_kind[i];
    add(other.stability[i], stability[i]);
  }
  score.frames += other.score.frames;
  add(other.markings, markings);
  add(other.lanes, lanes);
  styles.right += other.styles.right;
  styles.wrong += other.styles.wrong;
  styles.unknown += other.styles.unknown;
  add(other.topology.linkages, topology.linkages);
  for (std::size_t i = 0; i < kLinkageKindCount; ++i) add(other.topology.by_kind[i], topology.by_kind[i]);
  add(other.topology.directions, topology.directions);
  add(other.topology.stopline_lanes, topology.stopline_lanes);
  top_ll.average_precisions += other.top_ll.average_precisions;
  top_ll.vertices += other.top_ll.vertices;
  average_precision.add(other.average_precision);
  steadiness += other.steadiness;
  lane_metres += other.lane_metres;
  return *this;
}

Measures MapEvaluation::measures() const {
  Measures all{.score = score_,
               .markings = trust_.markings(),
               .lanes = trust_.lanes(),
               .styles = styles_,
               .topology = topology_,
               .top_ll = top_ll_,
               .average_precision = average_precision_,
               .steadiness = steadiness_.steadiness(),
               .lane_metres = lane_metres_.metres()};
  for (std::size_t i = 0; i < kLineKindCount; ++i) all.stability[i] = stability_.of(static_cast<LineKind>(i));
  return all;
}

}  // namespace laneloom::evaluation
