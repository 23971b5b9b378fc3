#include "experiment/spread_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace laneloom::experiment {
namespace {

SubjectResult result(const char* name, double recall) {
  SubjectResult result{.name = name, .measures = {}, .update_ms = {}};
  evaluation::Score& score = result.measures.score.by_kind[index(evaluation::LineKind::laneline)];
  score.truths = score.predictions = 1000;
  score.matches = static_cast<std::uint64_t>(1000 * recall);
  return result;
}

std::string table(const std::vector<std::array<double, 3>>& drives) {
  std::vector<DriveSpec> specs;
  std::vector<DriveResults> results;
  const auto road = std::make_shared<const simulation::Road>(simulation::Road{.name = "road"});
  for (const auto& [raw, own, oracle] : drives) {
    specs.push_back({.road = road, .noise = {.name = "noise"}, .seed = specs.size() + 1});
    results.push_back({result("raw", raw), result("own", own), result("oracle", oracle)});
  }
  return spread_table(specs, results);
}

TEST(SpreadTable, TellsMeanWorstDecileAndWorst) {
  std::vector<std::array<double, 3>> drives(18, {0.5, 0.8, 0.9});  // 75 % of the way
  drives.push_back({0.5, 0.68, 0.9});                              // 45 %
  drives.push_back({0.5, 0.6, 0.9});                               // 25 %
  EXPECT_NE(
      table(drives).find("| own | 71.0/45.0/25.0 (20 drives) | 78.4/68.0/60.0 | -/-/- | road noise 20 |"),
      std::string::npos)
      << table(drives);
}

TEST(SpreadTable, WhereThereIsNoWayNoneIsGone) {
  EXPECT_NE(table({{0.8, 0.7, 0.89}}).find("| own | -/-/- (0 drives) | 70.0/70.0/70.0 |"), std::string::npos);
}

TEST(SpreadTable, OfNoDrivesIsItsHead) { EXPECT_EQ(table({}).find("own"), std::string::npos); }

}  // namespace
}  // namespace laneloom::experiment
