#include "experiment/paired_table.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace laneloom::experiment {
namespace {

SubjectResult blinking(const char* name, std::size_t blinks) {
  SubjectResult result{.name = name, .measures = {}, .update_ms = {}};
  result.measures.steadiness.duration_s = 10.0;
  result.measures.steadiness.blinks = blinks;
  return result;
}

/// Each drive has raw, two configurations that blink so often, and an oracle.
std::string table_of(const std::vector<std::pair<std::size_t, std::size_t>>& blinks) {
  std::vector<DriveResults> results;
  for (const auto& [first, second] : blinks)
    results.push_back(
        {blinking("raw", 1000), blinking("A", first), blinking("B", second), blinking("oracle", 0)});
  return paired_table(results, 2);
}

TEST(PairedTable, TheIntervalIsStudents) {
  // Standard deviation 1, of three: 4.303 / sqrt(3).
  const MeanDifference difference = mean_difference({1.0, 2.0, 3.0});
  EXPECT_EQ(difference.count, 3u);
  EXPECT_NEAR(difference.mean, 2.0, 1e-12);
  EXPECT_NEAR(difference.half_width, 2.484, 1e-3);
}

TEST(PairedTable, TheIntervalOfManyIsNearlyThatOfANormalDistribution) {
  std::vector<double> differences;
  for (int i = 0; i < 101; ++i) differences.push_back(i % 2 == 0 ? 1.0 : -1.0);
  EXPECT_NEAR(mean_difference(differences).half_width, 1.984 / 10.05, 1e-3);
}

TEST(PairedTable, OneDifferenceTellsNoInterval) {
  EXPECT_EQ(mean_difference({3.0}).half_width, 0.0);
  EXPECT_NE(table_of({{10, 40}}).find("| blinks /s | 1.00 | +3.00 (1) |"), std::string::npos)
      << table_of({{10, 40}});
}

TEST(PairedTable, DifferencesAreOfOneDrive) {
  // The drives differ by 10 blinks per second, the configurations by 1 in each drive.
  const std::string paired = table_of({{0, 10}, {100, 110}, {200, 210}});
  EXPECT_NE(paired.find("| mean over drives | A | B: difference"), std::string::npos) << paired;
  EXPECT_NE(paired.find("| blinks /s | 10.00 | +1.00 ± 0.00 (3) |"), std::string::npos) << paired;
}

TEST(PairedTable, RatesLinkagesAndMetresOfLanes) {
  const auto rated = [](const char* name, std::size_t right) {
    SubjectResult result{.name = name, .measures = {}, .update_ms = {}};
    result.measures.topology.linkages = {.published = 10, .right = right, .truths = 20, .found = right};
    result.measures.lane_metres.by_class_m = {static_cast<double>(right), 10.0 - static_cast<double>(right)};
    return result;
  };
  const std::string paired = paired_table({{rated("raw", 0), rated("A", 8), rated("B", 6)}}, 2);
  EXPECT_NE(paired.find("| linkages P % | 80.00 | -20.00 (1) |"), std::string::npos) << paired;
  EXPECT_NE(paired.find("| linkages R % | 40.00 | -10.00 (1) |"), std::string::npos) << paired;
  EXPECT_NE(paired.find("| right metres of lanes % | 80.00 | -20.00 (1) |"), std::string::npos) << paired;
}

TEST(PairedTable, WhatADriveCannotTellDoesNotCount) {
  EXPECT_NE(table_of({{1, 2}, {1, 2}}).find("| gap p95 m | - | - |"), std::string::npos);
}

TEST(PairedTable, NeedsTwoConfigurations) {
  EXPECT_EQ(paired_table({{blinking("raw", 0), blinking("A", 0)}}, 1), "");
  EXPECT_EQ(paired_table({}, 2), "");
}

}  // namespace
}  // namespace laneloom::experiment
