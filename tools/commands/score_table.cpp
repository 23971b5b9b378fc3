#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/evaluation_tables.hpp"

namespace laneloom::commands {
namespace {

std::vector<std::pair<std::string, evaluation::Score>> rows(const evaluation::MapScore& score) {
  std::vector<std::pair<std::string, evaluation::Score>> rows;
  rows.reserve(kMarkingTypeCount + 2);
  for (const MarkingType type : kMarkingTypes)
    rows.emplace_back(name(evaluation::line_kind(type)), score.of(evaluation::line_kind(type)));
  rows.emplace_back("total", score.markings());
  rows.emplace_back(name(evaluation::LineKind::lane), score.of(evaluation::LineKind::lane));
  return rows;
}

}  // namespace

std::string score_table(const std::vector<NamedScore>& scores) {
  std::string table = fmt::format("{:<10} {:<6} {:>7} {:>7} {:>7} {:>8} {:>8} {:>8} {:>8}\n", "type", "",
                                  "P [%]", "R [%]", "F1 [%]", "ACD [m]", "truth", "found", "matched");
  const std::size_t kinds = scores.empty() ? 0 : rows(scores.front().second).size();
  for (std::size_t i = 0; i < kinds; ++i) {
    for (const auto& [who, map_score] : scores) {
      const auto [kind, score] = rows(map_score)[i];
      if (score.truths == 0 && score.predictions == 0) continue;
      table += fmt::format("{:<10} {:<6} {:>7.2f} {:>7.2f} {:>7.2f} {:>8.3f} {:>8} {:>8} {:>8}\n", kind, who,
                           100 * score.precision(), 100 * score.recall(), 100 * score.f1(), score.acd_m(),
                           score.truths, score.predictions, score.matches);
    }
  }
  return table;
}

nlohmann::json score_json(const std::vector<NamedScore>& scores) {
  nlohmann::json json;
  for (const auto& [who, map_score] : scores) {
    json[who]["frames"] = map_score.frames;
    for (const auto& [kind, score] : rows(map_score))
      json[who][kind] = {
          {"precision", score.precision()}, {"recall", score.recall()}, {"f1", score.f1()},
          {"acd_m", score.acd_m()},         {"truth", score.truths},    {"found", score.predictions},
          {"matched", score.matches}};
  }
  return json;
}

}  // namespace laneloom::commands
