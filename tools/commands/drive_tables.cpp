#include "commands/drive_tables.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

namespace laneloom::commands {
namespace {

using nlohmann::json;

drive::DriveScore sum_of(const std::vector<DriveResult>& results) {
  drive::DriveScore sum;
  for (const DriveResult& result : results) sum += result.score;
  return sum;
}

std::string row(const std::string& name, const drive::DriveScore& score) {
  const double share = score.driven_m > 0.0 ? 100.0 / score.driven_m : 0.0;
  return fmt::format(
      "| {} | {:.2f} | {} | {} | {:.2f}/{:.2f}/{:.2f}/{:.2f} | {} | {:.0f} m, {:.1f} % | {:.1f} | {:.1f} | "
      "{} | "
      "{:.2f}/{:.2f} | {:.2f}/{:.2f} | {:.3f}/{:.3f} |\n",
      name, 1e-3 * score.driven_m, score.departures.size(), score.road_ends, score.lateral_m.mean(),
      score.lateral_m.quantile(0.5), score.lateral_m.quantile(0.99), score.lateral_m.quantile(1.0),
      score.guesses.size(), score.guessed_m(), share * score.guessed_m(), share * score.remembered_m,
      share * score.inferred_m, score.missed_turns, score.lateral_mps2.quantile(0.99),
      score.lateral_mps2.quantile(1.0), score.jerk_mps3.quantile(0.99), score.jerk_mps3.quantile(1.0),
      score.curvature_rate.quantile(0.99), score.curvature_rate.quantile(1.0));
}

std::string guess_table(const drive::DriveScore& score) {
  std::map<std::string, std::pair<int, double>> causes;
  for (const drive::Guess& guess : score.guesses) {
    auto& [count, distance_m] = causes[name(guess.cause)];
    ++count;
    distance_m += guess.distance_m;
  }
  std::string text;
  for (const auto& [cause, sums] : causes)
    text += fmt::format("guesses, {}: {} over {:.0f} m\n", cause, sums.first, sums.second);
  return text;
}

json place_json(const Point& place) { return {place.x(), place.y(), place.z()}; }

json distribution_json(const Distribution& values) {
  return {{"mean", values.mean()},
          {"p50", values.quantile(0.5)},
          {"p99", values.quantile(0.99)},
          {"max", values.quantile(1.0)}};
}

json score_json(const drive::DriveScore& score) {
  json departures = json::array(), guesses = json::array();
  for (const drive::Departure& departure : score.departures)
    departures.push_back({{"how", name(departure.how)},
                          {"t", departure.time_s},
                          {"place", place_json(departure.place)},
                          {"lane", departure.lane},
                          {"in_intersection", departure.in_intersection},
                          {"guessed", departure.guessed}});
  for (const drive::Guess& guess : score.guesses)
    guesses.push_back({{"cause", name(guess.cause)},
                       {"t", guess.time_s},
                       {"place", place_json(guess.place)},
                       {"duration_s", guess.duration_s},
                       {"distance_m", guess.distance_m}});
  return {{"driven_m", score.driven_m},
          {"time_s", score.time_s},
          {"standing_s", score.standing_s},
          {"guessed_m", score.guessed_m()},
          {"remembered_m", score.remembered_m},
          {"inferred_m", score.inferred_m},
          {"lateral_error_m", distribution_json(score.lateral_m)},
          {"lateral_acceleration_mps2", distribution_json(score.lateral_mps2)},
          {"lateral_jerk_mps3", distribution_json(score.jerk_mps3)},
          {"curvature_rate_per_m_s", distribution_json(score.curvature_rate)},
          {"border_crossings", score.border_crossings},
          {"restarts", score.restarts()},
          {"road_ends", score.road_ends},
          {"missed_turns", score.missed_turns},
          {"departures", departures},
          {"guesses", guesses}};
}

}  // namespace

std::string drive_table(const std::vector<DriveResult>& results) {
  std::string text =
      "| | km | left lane | road ends | lateral error mean/p50/p99/max m | guesses | guessed | remembered % "
      "| inferred % | missed turns | lateral m/s² p99/max | jerk m/s³ | curvature rate 1/(m s) |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const DriveResult& result : results)
    text += row(fmt::format("{}, seed {}", result.road, result.seed), result.score);
  const drive::DriveScore sum = sum_of(results);
  if (results.size() > 1) text += row("all", sum);
  text += fmt::format("{} times the body crossed a border; standing {:.0f} of {:.0f} s\n",
                      sum.border_crossings, sum.standing_s, sum.time_s);
  text += guess_table(sum);
  for (const DriveResult& result : results) {
    for (const drive::Departure& departure : result.score.departures)
      text += fmt::format(
          "{}, seed {}: {} at {:.1f} s, ({:.1f}, {:.1f}), true lane {}{}{}\n", result.road, result.seed,
          name(departure.how), departure.time_s, departure.place.x(), departure.place.y(), departure.lane,
          departure.in_intersection ? ", in an intersection" : "", departure.guessed ? ", on a guess" : "");
  }
  return text;
}

json drive_json(const std::vector<DriveResult>& results) {
  json drives = json::array();
  for (const DriveResult& result : results) {
    json drive = score_json(result.score);
    drive["road"] = result.road;
    drive["seed"] = result.seed;
    drives.push_back(std::move(drive));
  }
  json all = score_json(sum_of(results));
  all.erase("departures");
  all.erase("guesses");
  return {{"drives", drives}, {"all", all}};
}

}  // namespace laneloom::commands
