#include "drives.hpp"
#include "export/survey.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "laneloom/polyline.hpp"

namespace laneloom::exports {
namespace {

using testing::SizeIs;

/// A map at x, whose line reaches 40 m back and ahead, at a lateral position.
LocalMap map_at(double x, double y) {
  LocalMap map;
  map.stamp_ns = static_cast<std::int64_t>(1e9 + 1e8 * x);
  map.T_map_body.translation() = Point(x, 0, 0);
  map.boundaries = {{.id = 1,
                     .points = {{x - 30, y, 0}, {x + 40, y, 0}},
                     .styles = {{{0.0, 70.0}, MarkingStyle::dashed}},
                     .existence_probability = 0.9,
                     .observations = 50}};
  return map;
}

SurveyedRoad road_of(DriveLines drive) {
  Survey survey;
  survey.add(std::move(drive));
  return survey.road();
}

SurveyedRoad drive_of(const std::vector<LocalMap>& maps) {
  return road_of(test::lines_of(maps, RangeConfig{}));
}

TEST(DriveAccumulator, KeepsWhatTheVehicleLeftBehind) {
  std::vector<LocalMap> maps;
  for (int i = 0; i <= 200; ++i) maps.push_back(map_at(i, 2.0));
  const SurveyedRoad drive = drive_of(maps);
  ASSERT_THAT(drive.markings, SizeIs(1));
  EXPECT_NEAR(length(drive.markings[0].points), 270.0, 1.0);
  EXPECT_NEAR(static_cast<double>(drive.poses.size()), 100.0, 2.0);
}

TEST(DriveAccumulator, APlaceIsAsItWasLastInTheMap) {
  std::vector<LocalMap> maps;
  for (int i = 0; i <= 100; ++i) maps.push_back(map_at(i, i < 20 ? 2.5 : 2.0));
  const SurveyedRoad drive = drive_of(maps);
  ASSERT_THAT(drive.markings, SizeIs(1));
  const MeasuredPolyline line(drive.markings[0].points);
  EXPECT_NEAR(line.project(Point(30, 2, 0)).foot.y(), 2.0, 1e-3) << "what was better known later";
}

TEST(DriveAccumulator, WhatTheMapWithdrewIsLeftOut) {
  std::vector<LocalMap> maps;
  for (int i = 0; i <= 100; ++i) {
    maps.push_back(map_at(i, 2.0));
    if (i < 10) maps.back().boundaries.push_back(map_at(10, -6.0).boundaries[0]);
  }
  for (LocalMap& map : maps)
    if (map.boundaries.size() > 1) map.boundaries[1].id = 2;
  EXPECT_THAT(drive_of(maps).markings, SizeIs(1));
}

TEST(DriveAccumulator, ARestartKeepsWhatWasKnown) {
  DriveAccumulator accumulator(RangeConfig{});
  for (int i = 0; i <= 50; ++i) accumulator.add(map_at(i, 2.0));
  accumulator.begin_anew();
  for (int i = 51; i <= 100; ++i) {
    LocalMap empty = map_at(i, 2.0);
    empty.boundaries.clear();
    accumulator.add(empty);
  }
  const SurveyedRoad drive = road_of(accumulator.finish());
  ASSERT_THAT(drive.markings, SizeIs(1));
  EXPECT_NEAR(length(drive.markings[0].points), 120.0, 1.0);
}

TEST(DriveAccumulator, InferredBoundariesAreLeftOut) {
  LocalMap map = map_at(0, 2.0);
  map.boundaries[0].status = ElementStatus::inferred;
  EXPECT_THAT(drive_of({map}).markings, SizeIs(0));
}

/// Maps of a drive along x, whose roadedge has a stretch of 30 m beneath the vehicle, at a lateral position.
SurveyedRoad drive_over_an_edge(double y) {
  std::vector<LocalMap> maps;
  for (int i = 0; i <= 100; ++i) {
    LocalMap map = map_at(i, 5.0);
    map.boundaries.push_back(map.boundaries[0]);
    map.boundaries[1].id = 2;
    map.boundaries[1].type = MarkingType::roadedge;
    map.boundaries[1].points = {{20, 3, 0}, {30, 3, 0}, {35, y, 0}, {65, y, 0}, {70, 3, 0}, {80, 3, 0}};
    maps.push_back(map);
  }
  return drive_of(maps);
}

TEST(DriveAccumulator, NoEdgeIsWhereTheVehicleDrove) {
  const auto drive = drive_over_an_edge(0.5);
  ASSERT_THAT(drive.markings, SizeIs(3)) << "the line, and both ends of the edge";
  for (ElementId id = 0; const Marking& marking : drive.markings) {
    EXPECT_EQ(marking.id, ++id);
    for (const Point& point : marking.points) EXPECT_GT(point.y(), 0.7);
  }
}

TEST(DriveAccumulator, AnEdgeBesideTheVehicleStays) {
  const auto drive = drive_over_an_edge(1.2);
  double edges_m = 0.0;
  for (const Marking& marking : drive.markings)
    if (marking.type == MarkingType::roadedge) edges_m += length(marking.points);
  EXPECT_NEAR(edges_m, 60.7, 1.0);
}

}  // namespace
}  // namespace laneloom::exports
