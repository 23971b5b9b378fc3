#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/evaluation_tables.hpp"
#include "evaluation/figure.hpp"
#include "evaluation/kind_lines.hpp"

namespace laneloom::commands {
namespace {

using evaluation::Figure, evaluation::null_or, evaluation::share;

Figure ratio(Figure of, Figure to) { return of && to && *to > 0.0 ? Figure(*of / *to) : std::nullopt; }

using Figures = evaluation::LaterScore::Figures;

std::string column(Figure figure, int width, int decimals, double unit = 1.0) {
  return " " + evaluation::cell(figure, decimals, width, unit);
}

std::string row(MarkingType type, double distance_m, const evaluation::LaterScore& score) {
  const Figures single = score.figures(score.single), map = score.figures(score.map);
  return fmt::format("{:<9}{:>3.0f} m{:>7}", name(evaluation::line_kind(type)), distance_m,
                     score.seen_later) +
         column(single.precision, 8, 1, 100) + column(map.precision, 6, 1, 100) +
         column(single.recall, 8, 1, 100) + column(map.recall, 6, 1, 100) + column(single.rms_m, 8, 3) +
         column(map.rms_m, 6, 3) + column(ratio(map.rms_m, single.rms_m), 5, 2) + column(single.p95_m, 8, 3) +
         column(map.p95_m, 6, 3) + column(ratio(map.p95_m, single.p95_m), 5, 2) + "\n";
}

Figure id_changes_per_km(const evaluation::LaterMeter& meter) {
  if (meter.own_lane().frames == 0) return std::nullopt;
  return 1000.0 * static_cast<double>(meter.own_lane().id_changes) / meter.driven_m();
}

std::string own_lane_line(const evaluation::LaterMeter& meter) {
  const evaluation::OwnLaneScore& own = meter.own_lane();
  std::string line =
      fmt::format("own lane in {:.1f} % of the frames", 100 * *share(own.frames, meter.frames()));
  if (own.frames > 0)
    line += fmt::format(", width 5/50/95 % {:.2f}/{:.2f}/{:.2f} m, {:.1f} id changes per km",
                        own.widths_m.quantile(0.05), own.widths_m.quantile(0.5), own.widths_m.quantile(0.95),
                        *id_changes_per_km(meter));
  return line + fmt::format("; {:.1f} lanes a frame\n", *share(meter.lanes(), meter.frames()));
}

nlohmann::json figures_json(const Figures& of) {
  return {{"precision", null_or(of.precision)},
          {"recall", null_or(of.recall)},
          {"lateral_rms_m", null_or(of.rms_m)},
          {"lateral_p95_m", null_or(of.p95_m)}};
}

nlohmann::json score_json(const evaluation::LaterScore& score) {
  const Figures single = score.figures(score.single), map = score.figures(score.map);
  return {{"seen_later", score.seen_later},
          {"pairs", score.map.lateral_errors_m.count()},
          {"single", figures_json(single)},
          {"map", figures_json(map)},
          {"lateral_rms_ratio", null_or(ratio(map.rms_m, single.rms_m))},
          {"lateral_p95_ratio", null_or(ratio(map.p95_m, single.p95_m))}};
}

nlohmann::json own_lane_json(const evaluation::LaterMeter& meter) {
  const evaluation::OwnLaneScore& own = meter.own_lane();
  const auto width = [&](double part) {
    return null_or(evaluation::when(own.frames > 0, own.widths_m.quantile(part)));
  };
  return {{"share", null_or(share(own.frames, meter.frames()))},
          {"width_p5_m", width(0.05)},
          {"width_p50_m", width(0.5)},
          {"width_p95_m", width(0.95)},
          {"id_changes", own.id_changes},
          {"id_changes_per_km", null_or(id_changes_per_km(meter))}};
}

}  // namespace

std::string later_table(const evaluation::LaterMeter& meter) {
  std::string table = fmt::format("{:<14}{:>7} {:>15} {:>15} {:>21} {:>21}\n", "seen later from", "lines",
                                  "precision %", "recall %", "lateral rms m", "lateral p95 m");
  table += fmt::format("{:<9}{:>5}{:>7} {:>8} {:>6} {:>8} {:>6} {:>8} {:>6} {:>5} {:>8} {:>6} {:>5}\n",
                       "close by", "ahead", "", "single", "map", "single", "map", "single", "map", "ratio",
                       "single", "map", "ratio");
  for (const MarkingType type : evaluation::kLaterTypes)
    for (std::size_t i = 0; i < evaluation::kLaterDistances_m.size(); ++i)
      if (meter.score(type, i).seen_later > 0)
        table += row(type, evaluation::kLaterDistances_m[i], meter.score(type, i));
  return table + own_lane_line(meter) +
         fmt::format("{} frames rated, on {:.0f} m\n", meter.frames(), meter.driven_m());
}

nlohmann::json later_json(const evaluation::LaterMeter& meter) {
  nlohmann::json json{{"frames", meter.frames()},
                      {"driven_m", meter.driven_m()},
                      {"lanes_per_frame", null_or(share(meter.lanes(), meter.frames()))},
                      {"own_lane", own_lane_json(meter)}};
  for (const MarkingType type : evaluation::kLaterTypes)
    for (std::size_t i = 0; i < evaluation::kLaterDistances_m.size(); ++i)
      json[name(evaluation::line_kind(type))][fmt::format("{:g}", evaluation::kLaterDistances_m[i])] =
          score_json(meter.score(type, i));
  return json;
}

}  // namespace laneloom::commands
