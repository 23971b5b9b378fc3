#include "experiment/paired_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "evaluation/figure.hpp"
#include "support/t_quantile.hpp"

namespace laneloom::experiment {
namespace {

using evaluation::Measures, evaluation::quantile, evaluation::share, evaluation::when;
using Value = evaluation::Figure;

struct Figure {
  const char* name;
  Value (*of)(const Measures&);
};

template <class Amount>
Value percent(Amount part, Amount whole) {
  const Value value = share(part, whole);
  return value ? Value(100.0 * *value) : value;
}

Value f1_percent(const evaluation::Score& score) {
  return when(score.predictions + score.truths > 0, 100.0 * score.f1());
}

Value per_second(const Measures& m, std::size_t events) {
  return when(m.steadiness.duration_s > 0.0, m.steadiness.per_second(events));
}

constexpr std::array kFigures{
    Figure{"F1 %", [](const Measures& m) { return f1_percent(m.score.markings()); }},
    Figure{"lanes F1 %",
           [](const Measures& m) { return f1_percent(m.score.of(evaluation::LineKind::lane)); }},
    Figure{"right metres of lanes %",
           [](const Measures& m) {
             const evaluation::LaneMetres& metres = m.lane_metres;
             return percent(metres.of(evaluation::LaneClass::right), metres.published_m());
           }},
    Figure{"directions of right metres, P %",
           [](const Measures& m) { return percent(m.lane_metres.told_right_m, m.lane_metres.told_m); }},
    Figure{"directions of right metres, R %",
           [](const Measures& m) {
             return percent(m.lane_metres.told_right_m, m.lane_metres.of(evaluation::LaneClass::right));
           }},
    Figure{"lanes ECE",
           [](const Measures& m) {
             return when(m.lanes.has_confidences(), m.lanes.expected_calibration_error());
           }},
    Figure{
        "linkages P %",
        [](const Measures& m) { return percent(m.topology.linkages.right, m.topology.linkages.published); }},
    Figure{"linkages R %",
           [](const Measures& m) { return percent(m.topology.linkages.found, m.topology.linkages.truths); }},
    Figure{"lanes in a map", [](const Measures& m) { return share(m.steadiness.lanes, m.steadiness.maps); }},
    Figure{"blinks /s", [](const Measures& m) { return per_second(m, m.steadiness.blinks); }},
    Figure{"short lives %",
           [](const Measures& m) { return percent(m.steadiness.short_lives, m.steadiness.ended); }},
    Figure{"turned /s", [](const Measures& m) { return per_second(m, m.steadiness.turned); }},
    Figure{"doubted /s", [](const Measures& m) { return per_second(m, m.steadiness.doubted); }},
    Figure{"own lane %",
           [](const Measures& m) { return percent(m.steadiness.own_lanes, m.steadiness.own_wanted); }},
    Figure{"way right %",
           [](const Measures& m) { return percent(m.steadiness.right_ways, m.steadiness.true_ways); }},
    Figure{"own ids /km",
           [](const Measures& m) {
             return when(m.steadiness.driven_m > 0.0, m.steadiness.own_changes_per_km());
           }},
    Figure{"reach p5 m", [](const Measures& m) { return quantile(m.steadiness.reach_m, 0.05); }},
    Figure{"reach p50 m", [](const Measures& m) { return quantile(m.steadiness.reach_m, 0.5); }},
    Figure{"gap p95 m", [](const Measures& m) { return quantile(m.steadiness.gap_m, 0.95); }},
    Figure{"step p95 m", [](const Measures& m) { return quantile(m.steadiness.step_m, 0.95); }},
    Figure{"kink p99 deg", [](const Measures& m) { return quantile(m.steadiness.kink_deg, 0.99); }},
    Figure{"jump p99 m, 0 m ahead", [](const Measures& m) { return quantile(m.steadiness.jump_m[0], 0.99); }},
    Figure{"jump p99 m, 10 m ahead",
           [](const Measures& m) { return quantile(m.steadiness.jump_m[1], 0.99); }},
    Figure{"jump p99 m, 20 m ahead",
           [](const Measures& m) { return quantile(m.steadiness.jump_m[2], 0.99); }}};

std::vector<double> differences(const std::vector<DriveResults>& results, std::size_t subject,
                                const Figure& figure) {
  std::vector<double> differences;
  for (const DriveResults& drive : results) {
    const Value first = figure.of(drive.at(1).measures), other = figure.of(drive.at(subject).measures);
    if (first && other) differences.push_back(*other - *first);
  }
  return differences;
}

std::string cell(const MeanDifference& difference) {
  if (difference.count == 0) return "-";
  const std::string interval = difference.count > 1 ? fmt::format(" ± {:.2f}", difference.half_width) : "";
  return fmt::format("{:+.2f}{} ({})", difference.mean, interval, difference.count);
}

std::string row(const std::vector<DriveResults>& results, std::size_t configs, const Figure& figure) {
  Distribution first;
  for (const DriveResults& drive : results)
    if (const Value value = figure.of(drive.at(1).measures)) first.add(*value);
  std::string row =
      fmt::format("| {} | {} |", figure.name, evaluation::cell(when(first.count() > 0, first.mean()), 2));
  for (std::size_t subject = 2; subject <= configs; ++subject)
    row += fmt::format(" {} |", cell(mean_difference(differences(results, subject, figure))));
  return row + "\n";
}

}  // namespace

MeanDifference mean_difference(const std::vector<double>& differences) {
  const Distribution all(differences);
  MeanDifference result{.count = differences.size(), .mean = all.mean()};
  if (result.count < 2) return result;
  double squares = 0.0;
  for (const double difference : differences)
    squares += (difference - result.mean) * (difference - result.mean);
  const auto count = static_cast<double>(result.count);
  result.half_width = support::t_quantile(result.count - 1) * std::sqrt(squares / (count - 1.0) / count);
  return result;
}

std::string paired_table(const std::vector<DriveResults>& results, std::size_t configs) {
  if (results.empty() || configs < 2) return {};
  std::string head = fmt::format("| mean over drives | {} |", results.front().at(1).name), rule = "|---|---|";
  for (std::size_t subject = 2; subject <= configs; ++subject) {
    head += fmt::format(" {}: difference ± 95 % (drives) |", results.front().at(subject).name);
    rule += "---|";
  }
  std::string table = head + "\n" + rule + "\n";
  for (const Figure& figure : kFigures) table += row(results, configs, figure);
  return table;
}

}  // namespace laneloom::experiment
