#include "batch/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <utility>

#include "support/t_quantile.hpp"

namespace laneloom::batch {
namespace {

const char* name(Result::State state) {
  switch (state) {
    case Result::State::made:
      return "made";
    case Result::State::kept:
      return "kept";
    case Result::State::failed:
      return "failed";
  }
  return "";
}

std::size_t count(const std::vector<Result>& results, Result::State state) {
  return static_cast<std::size_t>(std::ranges::count(results, state, &Result::state));
}

Figure figure(const std::string& name, const std::vector<std::pair<double, std::string>>& values) {
  Figure figure{.name = name, .drives = values.size()};
  const auto n = static_cast<double>(values.size());
  for (const auto& [value, drive] : values) figure.mean += value / n;
  double squares = 0.0;
  for (const auto& [value, drive] : values) squares += (value - figure.mean) * (value - figure.mean);
  if (values.size() > 1)
    figure.interval = support::t_quantile(values.size() - 1) * std::sqrt(squares / (n - 1.0) / n);
  const auto [least, most] =
      std::ranges::minmax_element(values, {}, [](const auto& one) { return one.first; });
  std::tie(figure.least, figure.least_drive) = *least;
  std::tie(figure.most, figure.most_drive) = *most;
  return figure;
}

std::string row(const Figure& figure) {
  return fmt::format("{:38} {:>9.4g} ± {:<8.2g} {:>9.4g} {:20} {:>9.4g} {}\n", figure.name, figure.mean,
                     figure.interval, figure.least, figure.least_drive, figure.most, figure.most_drive);
}

}  // namespace

std::vector<Figure> figures_of(const std::vector<Result>& results) {
  std::map<std::string, std::vector<std::pair<double, std::string>>> values;
  for (const Result& result : results) {
    if (result.state == Result::State::failed || result.output.extension() != ".json") continue;
    std::ifstream file(result.output);
    const nlohmann::json json = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
    if (!json.is_object()) continue;
    const nlohmann::json flat = json.flatten();
    for (const auto& [pointer, value] : flat.items())
      if (value.is_number())
        values[pointer.substr(1)].emplace_back(value.template get<double>(), result.drive.name);
  }
  std::vector<Figure> figures;
  figures.reserve(values.size());
  for (const auto& [name, of_drives] : values) figures.push_back(figure(name, of_drives));
  return figures;
}

std::string table(const Step& step, const std::vector<Result>& results) {
  std::string text;
  double total_s = 0.0;
  for (const Result& result : results) {
    total_s += result.duration_s;
    text += fmt::format("{:40} {:6}", result.drive.name, name(result.state));
    if (result.state == Result::State::made) text += fmt::format(" {:8.1f} s", result.duration_s);
    if (result.found_something) text += "  something wrong was found";
    if (!result.problem.empty()) text += "  " + result.problem;
    text += "\n";
  }
  text += fmt::format("{} drives: {} made in {:.1f} s of processes, {} kept, {} failed\n", results.size(),
                      count(results, Result::State::made), total_s, count(results, Result::State::kept),
                      count(results, Result::State::failed));
  std::string rows;
  const StepKind& kind = kind_of(step);
  for (const Figure& figure : figures_of(results))
    if (std::ranges::find(kind.figures, "/" + figure.name) != kind.figures.end()) rows += row(figure);
  if (!rows.empty())
    text += fmt::format("\n{:38} {:>9} ± {:8} {:>9} {:20} {:>9}\n", "over all drives", "mean", "95 %",
                        "least", "", "most") +
            rows;
  return text;
}

nlohmann::json to_json(const Step& step, const std::vector<Result>& results) {
  nlohmann::json drives = nlohmann::json::array();
  for (const Result& result : results) {
    nlohmann::json drive{{"drive", result.drive.name}, {"failed", result.state == Result::State::failed}};
    if (result.found_something) drive["found_something"] = true;
    if (!result.problem.empty()) drive["problem"] = result.problem;
    drives.push_back(std::move(drive));
  }
  nlohmann::json figures = nlohmann::json::object();
  for (const Figure& figure : figures_of(results))
    figures[figure.name] = {{"drives", figure.drives},
                            {"mean", figure.mean},
                            {"interval_95", figure.interval},
                            {"least", {{"value", figure.least}, {"drive", figure.least_drive}}},
                            {"most", {{"value", figure.most}, {"drive", figure.most_drive}}}};
  return {{"step", step.name}, {"options", step.options}, {"drives", drives}, {"figures", figures}};
}

}  // namespace laneloom::batch
