#include "experiment/results_table.hpp"

#include <fmt/format.h>

#include "evaluation/figure.hpp"

namespace laneloom::experiment {
namespace {

std::string number(bool known, double value, int decimals) {
  return evaluation::cell(evaluation::when(known, value), decimals);
}

std::string precision(const evaluation::Score& score, int decimals) {
  return number(score.predictions > 0, 100 * score.precision(), decimals);
}
std::string recall(const evaluation::Score& score, int decimals) {
  return number(score.truths > 0, 100 * score.recall(), decimals);
}
std::string f1(const evaluation::Score& score) {
  return number(score.predictions + score.truths > 0, 100 * score.f1(), 1);
}
std::string precision(const evaluation::PairScore& score, int decimals) {
  return number(score.published > 0, 100 * score.precision(), decimals);
}
std::string recall(const evaluation::PairScore& score) {
  return number(score.truths > 0, 100 * score.recall(), 0);
}

/// The score of linkages across intersections, of all kinds.
evaluation::PairScore across_gaps(const evaluation::TopologyScore& topology) {
  evaluation::PairScore sum;
  for (const auto kind : {Linkage::Kind::intersection, Linkage::Kind::sd_map, Linkage::Kind::ego_track}) {
    const evaluation::PairScore& score = topology.by_kind.at(static_cast<std::size_t>(kind));
    sum.published += score.published;
    sum.right += score.right;
  }
  return sum;
}

std::string row(const SubjectResult& result) {
  const evaluation::Measures& m = result.measures;
  const evaluation::Score markings = m.score.markings();
  const evaluation::Score& lanes = m.score.of(evaluation::LineKind::lane);
  const evaluation::Stability steady = m.markings_stability();
  const evaluation::PairScore &linkages = m.topology.linkages, &directions = m.topology.directions;
  const Distribution& first_s = m.markings.first_appearance_s;
  const bool times = result.update_ms.count() > 0;
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {} | {}/{}/{} | {}/{} | {} | {}/{} | {} | {} | {} | {} | {} "
      "| {}/{} |\n",
      result.name, precision(markings, 1), recall(markings, 1), f1(markings),
      number(markings.matches > 0, markings.acd_m(), 3),
      number(steady.jitter_m.count() > 0, 100 * steady.jitter_m.mean(), 2),
      number(steady.was_right > 0, 100 * steady.flicker(), 2),
      number(steady.has_ids, 0.1 * steady.id_switches_per_km(), 2), precision(lanes, 0), recall(lanes, 0),
      f1(lanes), precision(linkages, 0), recall(linkages), precision(across_gaps(m.topology), 0),
      precision(directions, 1), recall(directions), number(m.top_ll.vertices > 0, 100 * m.top_ll.value(), 1),
      number(markings.truths > 0, 100 * m.average_precision.map(), 1),
      number(m.markings.vertices > 0, 100 * m.markings.within_2_sigma(), 1),
      number(m.markings.has_confidences(), m.markings.expected_calibration_error(), 3),
      number(first_s.count() > 0, first_s.quantile(0.5), 1), number(times, result.update_ms.quantile(0.5), 2),
      number(times, result.update_ms.quantile(0.99), 2));
}

}  // namespace

std::string results_table(const std::vector<SubjectResult>& results) {
  std::string table =
      "| | P % | R % | F1 % | ACD m | jitter cm | flicker % | ids/100 m | lanes P/R/F1 % | linkages P/R % | "
      "across P % | directions P/R % | TOP_ll % | mAP % | 2σ % | ECE | first s | ms p50/p99 |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const SubjectResult& result : results) table += row(result);
  return table;
}

}  // namespace laneloom::experiment
