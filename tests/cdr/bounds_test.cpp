#include "cdr/bounds.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "cdr/convert.hpp"

namespace laneloom::dds {
namespace {

const Polyline kLine{{0, 0, 0}, {1, 0, 0}};
const Polyline kTooLong(msg::MAX_POINTS + 1, Point::Zero());

/// Lanes 1001, 1002, ... between boundaries 1, 2, 3, ...; each lane links to the next and has it as its
/// neighbour.
PublishedMap road_of(std::size_t lanes) {
  PublishedMap result;
  for (ElementId i = 0; i <= lanes; ++i)
    result.map.boundaries.push_back(Marking{.id = 1 + i, .points = kLine});
  for (ElementId i = 0; i < lanes; ++i) {
    const ElementId next = i + 1 < lanes ? 1002 + i : kNoElement;
    std::vector<Neighbour> beside;
    if (next != kNoElement) beside.push_back({.lane = next, .range = {0.0, 1.0}, .crossable = {}});
    result.map.lanes.push_back(Lane{.id = 1001 + i,
                                    .left_borders = {{.boundary = 1 + i}},
                                    .right_borders = {{.boundary = 2 + i}},
                                    .left = kLine,
                                    .right = kLine,
                                    .centerline = kLine,
                                    .right_neighbours = beside});
    if (next != kNoElement) result.map.linkages.push_back(Linkage{.from = 1001 + i, .to = next});
  }
  result.map.stoplines.push_back(
      Stopline{.marking = {.id = 5000, .points = kLine}, .lanes = {1001, 1000 + lanes}});
  return result;
}

TEST(Bounds, AMapThatFitsIsLeftAlone) {
  auto map = road_of(msg::MAX_LANES);
  EXPECT_TRUE(within_bounds(map));
  EXPECT_EQ(keep_within_bounds(map), 0U);
  EXPECT_EQ(map.map.lanes.size(), msg::MAX_LANES);
}

TEST(Bounds, WhatRefersToALaneThatWentGoesToo) {
  auto map = road_of(msg::MAX_LANES + 3);
  EXPECT_FALSE(within_bounds(map));
  EXPECT_EQ(keep_within_bounds(map), 3U + 3U);  // lanes and linkages
  EXPECT_TRUE(within_bounds(map));
  EXPECT_EQ(map.map.lanes.back().id, 1000U + msg::MAX_LANES);
  EXPECT_TRUE(map.map.lanes.back().right_neighbours.empty());
  EXPECT_EQ(map.map.linkages.back().to, 1000U + msg::MAX_LANES);
  EXPECT_EQ(map.map.stoplines[0].lanes, std::vector<ElementId>{1001});
}

TEST(Bounds, AnElementThatIsTooLongGoesAsAWhole) {
  auto map = road_of(4);
  map.map.boundaries[1].points = kTooLong;  // of lanes 1001 and 1002
  EXPECT_EQ(keep_within_bounds(map), 1U + 2U + 2U);
  ASSERT_EQ(map.map.lanes.size(), 2U);
  EXPECT_EQ(map.map.lanes[0].id, 1003U);
  ASSERT_EQ(map.map.linkages.size(), 1U);
  EXPECT_EQ(map.map.linkages[0].from, 1003U);
}

TEST(Bounds, AnUnseenBorderIsNoReasonToLeaveALaneOut) {
  auto map = road_of(1);
  map.map.lanes[0].left_borders.push_back({.boundary = kNoElement});
  EXPECT_EQ(keep_within_bounds(map), 0U);
  map.map.lanes[0].left_borders.push_back({.boundary = 99});
  EXPECT_EQ(keep_within_bounds(map), 1U) << "its boundary is not there";
  map = road_of(1);
  map.map.lanes[0].left_borders.resize(msg::MAX_BORDERS + 1);
  EXPECT_EQ(keep_within_bounds(map), 1U);
}

TEST(Bounds, AWayThroughALaneThatWentGoesToo) {
  auto map = road_of(2);
  map.map.way = Way{.stations = {{.lane = 1001}, {.lane = 1002}}, .lanes = {{.id = 1001}, {.id = 1002}}};
  EXPECT_EQ(keep_within_bounds(map), 0U);
  EXPECT_TRUE(map.map.way);
  map.map.boundaries[2].points = kTooLong;  // of lane 1002
  keep_within_bounds(map);
  EXPECT_FALSE(map.map.way);
  map = road_of(1);
  map.map.way = Way{.stations = std::vector<WayStation>(msg::MAX_WAY_STATIONS + 1), .lanes = {}};
  EXPECT_FALSE(within_bounds(map));
  EXPECT_EQ(keep_within_bounds(map), 1U);
}

TEST(Bounds, EveryListIsBounded) {
  auto map = road_of(2);
  map.fused_frames.resize(msg::MAX_FRAMES + 1);
  map.map.lineage.resize(msg::MAX_LINKAGES + 1);
  map.map.boundaries[2].styles.resize(65);
  map.map.stoplines[0].lanes.assign(33, 1001);
  map.map.linkages[0].path = kTooLong;
  map.map.driven_paths.resize(msg::MAX_DRIVEN_PATHS + 1);
  keep_within_bounds(map);
  EXPECT_TRUE(within_bounds(map));
  RoadMarkings markings;
  markings.markings.resize(msg::MAX_MARKINGS + 2);
  EXPECT_EQ(keep_within_bounds(markings), 2U);
}

TEST(Bounds, MessagesOfWhatIsTooLargeAreValid) {
  msg::LaneMap map_message;
  EXPECT_GT(to_msg(road_of(msg::MAX_LANES + 1), "map", map_message), 0U);
  EXPECT_EQ(map_message.lanes().size(), msg::MAX_LANES);

  DetectionFrame frame;
  frame.detections.assign(msg::MAX_MARKINGS + 2, Detection{.points = kLine});
  frame.detections[0].points = kTooLong;
  frame.field_of_view = kTooLong;
  frame.occluded_areas.assign(msg::MAX_AREAS + 1, kLine);
  msg::Detections detections;
  EXPECT_EQ(to_msg(frame, "map", detections), 2U + 1U + 1U);
  EXPECT_EQ(detections.detections().size(), msg::MAX_MARKINGS);

  ServiceStatus status;
  status.counters.resize(msg::MAX_COUNTERS + 1);
  status.sources.resize(msg::MAX_SOURCES + 2);
  status.sources.back().session_id = 9;
  msg::ServiceStatus status_message;
  EXPECT_EQ(to_msg(status, "map", status_message), 1U + 2U);
  EXPECT_EQ(status_message.sources().back().session_id(), 9U) << "the newest are left out";
}

// The IDL has numbers, which every generator of code knows, and this code has their names.
TEST(Bounds, AreThoseOfTheIdl) {
  const std::map<std::string, std::size_t> bounds{
      {"Point", kMaxLength<Point>},
      {"double", kMaxLength<double>},
      {"MarkingType", kMaxLength<MarkingType>},
      {"Area", kMaxLength<Polyline>},
      {"Detection", kMaxLength<Detection>},
      {"StateReason", kMaxLength<StateReason>},
      {"FusedFrame", kMaxLength<FusedFrame>},
      {"StyleRange", kMaxLength<StyleRange>},
      {"Marking", kMaxLength<Marking>},
      {"Range", kMaxLength<Stretch>},
      {"Neighbour", kMaxLength<Neighbour>},
      {"Border", kMaxLength<Border>},
      {"Lane", kMaxLength<Lane>},
      {"unsigned long long", kMaxLength<ElementId>},
      {"Stopline", kMaxLength<Stopline>},
      {"Linkage", kMaxLength<Linkage>},
      {"WayStation", kMaxLength<WayStation>},
      {"WayLane", kMaxLength<WayLane>},
      {"DrivenPath", kMaxLength<DrivenPath>},
      {"TrackedObject", kMaxLength<TrackedObject>},
      {"LineageEvent", kMaxLength<LineageEvent>},
      {"NamedValue", msg::MAX_VALUES},
      {"Counter", msg::MAX_COUNTERS},
      {"SourceStatus", msg::MAX_SOURCES},
      {"Setting", msg::MAX_SETTINGS},
  };
  const std::regex sequence(R"(sequence<([\w ]+), (\w+)>\s+(\w+))");
  std::size_t found = 0;
  for (const auto& file : std::filesystem::directory_iterator(LANELOOM_IDL)) {
    std::ostringstream text;
    text << std::ifstream(file.path()).rdbuf();
    const std::string idl = text.str();
    for (auto at = std::sregex_iterator(idl.begin(), idl.end(), sequence); at != std::sregex_iterator();
         ++at) {
      if ((*at)[3] == "covariance") continue;  // a matrix
      EXPECT_EQ((*at)[2], std::to_string(bounds.at((*at)[1]))) << file.path() << ": " << at->str();
      ++found;
    }
  }
  EXPECT_GT(found, bounds.size());
}

}  // namespace
}  // namespace laneloom::dds
