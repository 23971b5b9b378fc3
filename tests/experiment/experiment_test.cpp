#include "experiment/experiment.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "experiment/calibration.hpp"
#include "experiment/oracle.hpp"
#include "experiment/results_table.hpp"
#include "io/work_folder.hpp"
#include "simulation/scenarios.hpp"
#include "thrown_by.hpp"

namespace laneloom::experiment {
namespace {

DriveSpec spec(const std::string& scenario, const std::string& noise, double duration_s) {
  return {.road = std::make_shared<const simulation::Road>(simulation::make_scenario(scenario)),
          .noise = simulation::noise_profile(noise),
          .seed = 3,
          .duration_s = duration_s};
}

TEST(DriveSimulation, OneSpecGivesTheSameFrames) {
  const auto once = simulate(spec("split", "inhouse", 5.0)), again = simulate(spec("split", "inhouse", 5.0));
  ASSERT_EQ(once.size(), 50U);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(to_json_line(once[i].record), to_json_line(again[i].record));
    EXPECT_EQ(once[i].sources.size(), once[i].record.frame.detections.size());
    EXPECT_EQ(once[i].sources, again[i].sources);
    EXPECT_TRUE(transform(once[i].record.pose).isApprox(once[i].T_map_body));
  }
}

TEST(DriveSimulation, OdometryDriftsByItsShareOfTheDistance) {
  DriveSpec drifting = spec("straight", "none", 11.0);
  drifting.drift = 0.01;
  const auto frames = simulate(drifting);
  const Point error =
      transform(frames.back().record.pose).translation() - frames.back().T_map_body.translation();
  const Point start = frames.front().T_map_body.translation();
  const double driven_m = (frames.back().T_map_body.translation() - start).norm();
  EXPECT_NEAR(std::abs(error.x()), 0.01 * driven_m, 0.05);
  EXPECT_NEAR(std::abs(error.y()), 0.00005 * driven_m * driven_m, 0.1);
}

TEST(Oracle, WithoutNoiseKnowsTheTruth) {
  ExperimentSpec experiment;
  experiment.drives = {spec("split", "none", 20.0)};
  experiment.oracle = true;
  const auto results = sum(run(experiment));
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(results[0].name, "raw");
  EXPECT_EQ(results[1].name, "oracle");
  for (const SubjectResult& result : results) {
    EXPECT_GT(result.measures.score.markings().f1(), 0.99) << result.name;
    EXPECT_LT(result.measures.score.markings().acd_m(), 0.03) << result.name;
  }
}

TEST(Oracle, GivesTheMeanOfWhatItSaw) {
  simulation::Road road;
  road.markings.push_back({.id = 5, .points = {{0, 0, 0}, {20, 0, 0}}});
  Oracle oracle(road);
  const auto see = [&](double y_m) {
    SimulatedFrame frame;
    frame.record.frame.detections = {Detection{.points = {{-1, y_m, 0}, {21, y_m, 0}}},
                                     Detection{.points = {{0, 1, 0}, {20, 1, 0}}}};
    frame.sources = {5, kNoElement};  // the second one is a ghost
    return oracle.update(frame);
  };
  see(0.1);
  const LocalMap map = see(0.5);
  ASSERT_EQ(map.boundaries.size(), 1U);
  EXPECT_EQ(map.boundaries[0].id, 5U);
  for (const Point& point : map.boundaries[0].points) EXPECT_NEAR(point.y(), 0.3, 1e-9);
}

TEST(Oracle, PassesOverMarkingsWithoutHorizontalLength) {
  simulation::Road road;
  road.markings.push_back({.id = 5, .points = {{1, 2, 0}, {1, 2, 3}}});
  road.markings.push_back({.id = 6, .points = {{0, 0, 0}, {0, 5e-324, 0}}});
  EXPECT_TRUE(Oracle(road).update({}).boundaries.empty());
}

TEST(Experiment, DrivesAddUpWhateverRunsFirst) {
  ExperimentSpec one, both;
  one.drives = {spec("straight", "inhouse", 10.0)};
  both.drives = {one.drives[0], spec("curve", "inhouse", 10.0)};
  one.configs = both.configs = {{"ours", Config{}}};
  const auto single = sum(run(one)), sums = sum(run(both)), again = sum(run(both));
  ASSERT_EQ(sums.size(), 2U);
  EXPECT_EQ(sums[1].name, "ours");
  EXPECT_EQ(single[1].measures.score.frames, 100U);
  EXPECT_EQ(sums[1].measures.score.frames, 200U);
  EXPECT_EQ(sums[1].update_ms.count(), 200U);
  EXPECT_GT(sums[1].measures.score.markings().matches, single[1].measures.score.markings().matches);
  EXPECT_GT(sums[1].measures.average_precision.map(), 0.0);
  EXPECT_EQ(sums[1].measures.score.markings().chamfer_distances_m,
            again[1].measures.score.markings().chamfer_distances_m);
  EXPECT_EQ(sums[1].measures.markings_stability().id_switches,
            again[1].measures.markings_stability().id_switches);
}

TEST(Experiment, AMapIsRatedWhereADriftingVehicleSeesIt) {
  ExperimentSpec experiment;
  experiment.drives = {spec("straight", "none", 20.0)};
  experiment.drives[0].drift = 0.01;
  experiment.configs = {{"ours", Config{}}};
  // In the map frame the lines are off by metres at the end.
  EXPECT_GT(sum(run(experiment))[1].measures.score.markings().f1(), 0.95);
}

TEST(Experiment, APeerThatFailsIsNamed) {
  ExperimentSpec experiment;
  experiment.drives = {spec("straight", "none", 1.0)};
  for (const char* program : {"/bin/false", "/nowhere/peer"}) {
    experiment.peer = Peer{program, "inhouse"};
    EXPECT_THAT(thrown_by([&] { run(experiment); }), testing::HasSubstr(program)) << program;
  }
}

TEST(Peer, WhatItPrintsIsNotOurOutput) {
  const io::WorkFolder folder;
  const std::string program = folder.file("peer");
  std::ofstream(program) << "#!/bin/sh\necho progress\nexit 1\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_THROW(run_peer({program, "inhouse"}, {}), std::runtime_error);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "progress\n");
}

/// The cells of the table's only row, without the subject's name.
std::vector<std::string> cells(const evaluation::Measures& measures) {
  const std::string table = results_table({{"ours", measures, {}}});
  std::istringstream row(table.substr(table.find("| ours |") + 8));
  std::vector<std::string> cells;
  for (std::string cell; std::getline(row, cell, '|') && cell != "\n";)
    cells.push_back(cell.substr(1, cell.size() - 2));
  return cells;
}

TEST(ResultsTable, WhatIsNotDefinedIsADash) {
  const std::vector<std::string> all_dashes{"-", "-",   "-", "-", "-", "-", "-", "-/-/-", "-/-",
                                            "-", "-/-", "-", "-", "-", "-", "-", "-/-"};
  EXPECT_EQ(cells({}), all_dashes);
}

TEST(ResultsTable, WhatWasThereAndNotFoundIsZero) {
  evaluation::Measures missed;
  missed.score.by_kind[index(evaluation::LineKind::laneline)].truths = 3;
  missed.score.by_kind[index(evaluation::LineKind::lane)].truths = 2;
  missed.topology.linkages.truths = 2;
  missed.top_ll.vertices = 4;
  const std::vector<std::string> row = cells(missed);
  EXPECT_EQ(row.at(0), "-");
  EXPECT_EQ(row.at(1), "0.0");
  EXPECT_EQ(row.at(3), "-") << "ACD of no match";
  EXPECT_EQ(row.at(7), "-/0/0.0");
  EXPECT_EQ(row.at(8), "-/0");
  EXPECT_EQ(row.at(11), "0.0");
}

TEST(ResultsTable, WrongLinkagesWhereThereAreNoneHaveNoRecall) {
  evaluation::Measures invented;
  invented.topology.linkages.published = 2;
  EXPECT_EQ(cells(invented).at(8), "0/-");
}

TEST(ResultsTable, LinkagesAcrossAreAllThatBridgeAGap) {
  evaluation::Measures measures;
  const auto add = [&](Linkage::Kind kind, std::size_t published, std::size_t right) {
    measures.topology.by_kind.at(static_cast<std::size_t>(kind)) = {.published = published, .right = right};
  };
  add(Linkage::Kind::shared_boundary, 100, 0);
  add(Linkage::Kind::intersection, 2, 0);
  add(Linkage::Kind::sd_map, 4, 2);
  add(Linkage::Kind::ego_track, 4, 4);
  EXPECT_EQ(cells(measures).at(9), "60");
}

TEST(Experiment, TheOracleMissesNoLanesAsItKnowsNone) {
  ExperimentSpec experiment;
  experiment.drives = {spec("straight", "none", 2.0)};
  experiment.oracle = true;
  const evaluation::Measures oracle = sum(run(experiment)).back().measures;
  EXPECT_EQ(oracle.score.of(evaluation::LineKind::lane).truths, 0U);
  EXPECT_EQ(oracle.top_ll.vertices, 0U);
}

TEST(Calibration, MovesTheProfileToItsTarget) {
  simulation::NoiseProfile noise = simulation::noise_profile("none");
  noise.offset_stddev_m = 0.05;
  noise.line_memory_s = 1.0;
  noise.flutter_stddev_m = 0.01;
  CalibrationTarget target;
  target.kinds[index(MarkingType::laneline)] = {.precision = 0.9, .recall = 0.8, .acd_m = 0.1};
  target.jitter_m = 0.05;
  std::vector<DriveSpec> drives{spec("straight", "none", 20.0)};
  drives.push_back(drives[0]);
  drives.back().seed = 4;
  int told = 0;
  const CalibrationStep last =
      calibrate(noise, target, drives, RangeConfig{}, 10, [&](const CalibrationStep& /*step*/) { ++told; });
  EXPECT_EQ(told, 10);
  const evaluation::Score& score = last.score.of(evaluation::LineKind::laneline);
  EXPECT_NEAR(score.precision(), 0.9, 0.06);
  EXPECT_NEAR(score.recall(), 0.8, 0.06);
  EXPECT_NEAR(score.acd_m(), 0.1, 0.03);
  EXPECT_GT(last.noise.missed_share[index(MarkingType::laneline)], 0.05);
  // A share without a target stays as it was.
  EXPECT_EQ(last.noise.missed_share[index(MarkingType::roadedge)], 0.0);
}

TEST(Calibration, AnUnknownDataSetIsRefused) {
  EXPECT_THROW(calibration_target("nowhere"), std::invalid_argument);
}

}  // namespace
}  // namespace laneloom::experiment
