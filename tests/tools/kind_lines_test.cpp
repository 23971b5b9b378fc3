#include "evaluation/kind_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace laneloom {
namespace {

simulation::RoadLane road_lane(ElementId id, double from_x, std::vector<ElementId> successors,
                               ElementId right_marking = 1) {
  simulation::RoadLane l;
  l.id = id;
  l.centerline = {{from_x, 0, 0}, {from_x + 10, 0, 0}};
  l.left_marking = 1;
  l.right_marking = right_marking;
  l.successors = std::move(successors);
  return l;
}

std::vector<std::size_t> points_per_lane(const simulation::Road& truth) {
  std::vector<std::size_t> counts;
  for (const evaluation::KindLine& line : evaluation::kind_lines(truth))
    if (line.kind == evaluation::LineKind::lane) counts.push_back(line.points.size());
  return counts;
}

TEST(TruthLines, JoinLanesThatOnlyContinue) {
  simulation::Road truth;
  truth.lanes = {road_lane(1, 0, {2}), road_lane(2, 10, {3}), road_lane(3, 20, {})};
  EXPECT_THAT(points_per_lane(truth), testing::ElementsAre(6u));
}

TEST(TruthLines, KeepLanesApartWhereTheySplitAndMerge) {
  simulation::Road truth;
  truth.lanes = {road_lane(1, 0, {2, 3}), road_lane(2, 10, {4}), road_lane(3, 10, {4}), road_lane(4, 20, {})};
  EXPECT_THAT(points_per_lane(truth), testing::ElementsAre(2u, 2u, 2u, 2u));
}

TEST(TruthLines, HoldLanesWithAMarkingOnOneSide) {
  simulation::Road truth;
  truth.lanes = {road_lane(1, 0, {2}), road_lane(2, 10, {3}, kNoElement), road_lane(3, 20, {})};
  EXPECT_THAT(points_per_lane(truth), testing::ElementsAre(6u));
}

TEST(TruthLines, LeaveOutLanesThatNobodySeesAndCutThere) {
  simulation::Road truth;
  truth.lanes = {road_lane(1, 0, {2}), road_lane(2, 10, {3}, kNoElement), road_lane(3, 20, {4}),
                 road_lane(4, 30, {5}), road_lane(5, 40, {})};
  truth.lanes[1].left_marking = kNoElement;
  truth.lanes[3].in_intersection = true;
  EXPECT_THAT(points_per_lane(truth), testing::ElementsAre(2u, 2u, 2u));
}

TEST(TruthLines, TakeARingOnce) {
  simulation::Road truth;
  truth.lanes = {road_lane(1, 0, {2}), road_lane(2, 10, {1})};
  EXPECT_THAT(points_per_lane(truth), testing::ElementsAre(4u));
}

TEST(TruthLines, HoldTheMarkings) {
  simulation::Road truth;
  truth.markings = {{7, MarkingType::stopline, MarkingStyle::unknown, {{0, 0, 0}, {0, 3, 0}}}};
  const std::vector<evaluation::KindLine> lines = evaluation::kind_lines(truth);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].kind, evaluation::LineKind::stopline);
}

TEST(DetectionLines, AreInTheMapFrameAndSureEnough) {
  DetectionFrame frame;
  frame.detections = {{MarkingType::roadedge, MarkingStyle::unknown, 0.3, {{1, 2, 3}, {4, 2, 3}}, {}},
                      {MarkingType::roadedge, MarkingStyle::unknown, 0.29, {{1, 2, 3}, {4, 2, 3}}, {}}};
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  T_map_body.translate(Point(10, 20, 30));
  const std::vector<evaluation::KindLine> lines = evaluation::kind_lines(frame, T_map_body, 0.3);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].kind, evaluation::LineKind::roadedge);
  EXPECT_TRUE(lines[0].points[0].isApprox(Point(11, 22, 33)));
}

TEST(MapLines, AreBoundariesStoplinesAndLanes) {
  LocalMap map;
  map.boundaries.resize(2);
  map.boundaries[1].type = MarkingType::roadedge;
  map.stoplines.resize(1);
  map.stoplines[0].marking.type = MarkingType::stopline;
  map.lanes.resize(1);
  map.markings.resize(5);
  std::vector<evaluation::LineKind> kinds;
  for (const evaluation::KindLine& line : evaluation::kind_lines(map)) kinds.push_back(line.kind);
  EXPECT_THAT(kinds, testing::ElementsAre(evaluation::LineKind::stopline, evaluation::LineKind::laneline,
                                          evaluation::LineKind::roadedge, evaluation::LineKind::lane));
}

TEST(MapLines, LeaveOutBoundariesThatAreInferred) {
  LocalMap map;
  map.boundaries.resize(1);
  EXPECT_EQ(evaluation::kind_lines(map).size(), 1u);
  map.boundaries[0].status = ElementStatus::inferred;
  EXPECT_TRUE(evaluation::kind_lines(map).empty());
}

Lane published(ElementId id, double from_x) {
  Lane lane;
  lane.id = id;
  lane.centerline = {{from_x, 0, 0}, {from_x + 10, 0, 0}};
  return lane;
}

Linkage link(ElementId from, ElementId to, Linkage::Kind kind = Linkage::Kind::shared_boundary) {
  Linkage linkage;
  linkage.from = from;
  linkage.to = to;
  linkage.kind = kind;
  return linkage;
}

TEST(MapLines, NameAChainAfterItsLongestLane) {
  LocalMap map;
  map.lanes = {published(1, 0), published(2, 10), published(3, 30)};
  map.lanes[1].centerline.back().x() = 30;
  map.lanes[0].existence_probability = 0.9;
  map.lanes[1].existence_probability = 0.6;
  map.linkages = {link(1, 2), link(2, 3)};
  const std::vector<evaluation::KindLine> lines = evaluation::kind_lines(map);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].id, 2u);
  EXPECT_DOUBLE_EQ(lines[0].confidence, 0.7) << "of the 30 m that tell theirs";
}

TEST(MapLines, JoinLanesThatOnlyContinue) {
  LocalMap map;
  map.lanes = {published(1, 0), published(2, 15), published(3, 25), published(4, 25)};
  map.linkages = {link(1, 2, Linkage::Kind::geometric_alignment)};
  map.linkages[0].path = {{10, 0, 0}, {12, 0, 0}, {15, 0, 0}};
  const auto lanes = [&] {
    std::vector<std::pair<ElementId, std::size_t>> points;
    for (const evaluation::KindLine& line : evaluation::kind_lines(map))
      points.emplace_back(line.id, line.points.size());
    return points;
  };
  using testing::Pair;
  EXPECT_THAT(lanes(), testing::ElementsAre(Pair(1u, 7u), Pair(3u, 2u), Pair(4u, 2u)));
  map.linkages[0].kind = Linkage::Kind::intersection;
  EXPECT_EQ(lanes().size(), 4u) << "across an intersection they are two";
  map.linkages = {link(2, 3), link(2, 4)};
  EXPECT_EQ(lanes().size(), 4u) << "where they split, too";
}

}  // namespace
}  // namespace laneloom
