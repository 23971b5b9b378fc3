#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/evaluation_tables.hpp"
#include "evaluation/figure.hpp"

namespace laneloom::commands {
namespace {

using evaluation::cell, evaluation::null_or, evaluation::quantile, evaluation::share;
using evaluation::Figure, evaluation::Steadiness;

Figure per_second(const Steadiness& of, std::size_t events) {
  return evaluation::when(of.duration_s > 0.0, of.per_second(events));
}

Figure changes_per_km(const Steadiness& of) {
  return evaluation::when(of.driven_m > 0.0, of.own_changes_per_km());
}

std::string row(const std::string& what, const std::string& figures) {
  return fmt::format("{:<46} {}\n", what, figures);
}

std::string lane_rows(const Steadiness& of) {
  return row("lanes in a map", cell(share(of.lanes, of.maps), 2)) +
         row("lanes blink /s", cell(per_second(of, of.blinks), 2)) +
         row("  short lives % of those that went", cell(share(of.short_lives, of.ended), 1, 0, 100)) +
         row("centerlines turn round /s", cell(per_second(of, of.turned), 2)) +
         row("directions doubted /s", cell(per_second(of, of.doubted), 2)) +
         row("own lane %", cell(share(of.own_lanes, of.own_wanted), 1, 0, 100)) +
         row("own lane's id changes /km", cell(changes_per_km(of), 2));
}

std::string way_rows(const Steadiness& of) {
  std::string rows = row("way reaches [m] p5 p50",
                         cell(quantile(of.reach_m, 0.05), 1) + " " + cell(quantile(of.reach_m, 0.5), 1)) +
                     row("gap at its joints [m] p95", cell(quantile(of.gap_m, 0.95), 2)) +
                     row("step at its joints [m] p95", cell(quantile(of.step_m, 0.95), 2)) +
                     row("kink [deg] p99", cell(quantile(of.kink_deg, 0.99), 1));
  std::string jumps;
  for (const Distribution& jump_m : of.jump_m) jumps += cell(quantile(jump_m, 0.99), 2) + " ";
  jumps.pop_back();
  rows += row("jump 0, 10, 20 m ahead [m] p99", jumps);
  if (of.true_ways > 0)
    rows += row("way right over 10 m %", cell(share(of.right_ways, of.true_ways), 1, 0, 100));
  return rows;
}

}  // namespace

std::string steadiness_table(const Steadiness& steadiness) {
  if (steadiness.maps == 0) return {};
  return fmt::format("\nWhat the planner takes, from {} maps in {:.1f} s, {:.0f} m\n", steadiness.maps,
                     steadiness.duration_s, steadiness.driven_m) +
         lane_rows(steadiness) + way_rows(steadiness);
}

nlohmann::json steadiness_json(const Steadiness& of) {
  nlohmann::json json{{"maps", of.maps},
                      {"duration_s", of.duration_s},
                      {"driven_m", of.driven_m},
                      {"lanes_per_map", null_or(share(of.lanes, of.maps))},
                      {"blinks_per_s", null_or(per_second(of, of.blinks))},
                      {"short_lives", null_or(share(of.short_lives, of.ended))},
                      {"turned_per_s", null_or(per_second(of, of.turned))},
                      {"doubted_per_s", null_or(per_second(of, of.doubted))},
                      {"own_lane", null_or(share(of.own_lanes, of.own_wanted))},
                      {"own_id_changes_per_km", null_or(changes_per_km(of))},
                      {"reach_p5_m", null_or(quantile(of.reach_m, 0.05))},
                      {"reach_p50_m", null_or(quantile(of.reach_m, 0.5))},
                      {"gap_p95_m", null_or(quantile(of.gap_m, 0.95))},
                      {"step_p95_m", null_or(quantile(of.step_m, 0.95))},
                      {"kink_p99_deg", null_or(quantile(of.kink_deg, 0.99))},
                      {"right_way", null_or(share(of.right_ways, of.true_ways))}};
  for (std::size_t i = 0; i < evaluation::kJumpsAhead_m.size(); ++i)
    json["jump_p99_m"][fmt::format("{:g}", evaluation::kJumpsAhead_m[i])] =
        null_or(quantile(of.jump_m[i], 0.99));
  return json;
}

}  // namespace laneloom::commands
