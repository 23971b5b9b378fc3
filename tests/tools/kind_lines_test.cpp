#include "evaluation/kind_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace laneloom {
namespace {

RoadLane lane(ElementId id, double from_x, std::vector<ElementId> successors, ElementId right_marking = 1) {
  RoadLane l;
  l.id = id;
  l.centerline = {{from_x, 0, 0}, {from_x + 10, 0, 0}};
  l.left_marking = 1;
  l.right_marking = right_marking;
  l.successors = std::move(successors);
  return l;
}

std::vector<std::size_t> points_per_lane(const Road& truth) {
  std::vector<std::size_t> counts;
  for (const KindLine& line : kind_lines(truth))
    if (line.kind == LineKind::lane) counts.push_back(line.points.size());
  return counts;
}

TEST(TruthLines, JoinLanesThatOnlyContinue) {
  Road truth;
  truth.lanes = {lane(1, 0, {2}), lane(2, 10, {3}), lane(3, 20, {})};
  EXPECT_THAT(points_per_lane(truth), testing::ElementsAre(6u));
}

TEST(TruthLines, KeepLanesApartWhereTheySplitAndMerge) {
  Road truth;
  truth.lanes = {lane(1, 0, {2, 3}), lane(2, 10, {4}), lane(3, 10, {4}), lane(4, 20, {})};
  EXPECT_THAT(points_per_lane(truth), testing::ElementsAre(2u, 2u, 2u, 2u));
}

TEST(TruthLines, LeaveOutLanesWithoutMarkingsAndCutThere) {
  Road truth;
  truth.lanes = {lane(1, 0, {2}), lane(2, 10, {3}, kNoElement), lane(3, 20, {})};
  EXPECT_THAT(points_per_lane(truth), testing::ElementsAre(2u, 2u));
}

TEST(TruthLines, TakeARingOnce) {
  Road truth;
  truth.lanes = {lane(1, 0, {2}), lane(2, 10, {1})};
  EXPECT_THAT(points_per_lane(truth), testing::ElementsAre(4u));
}

TEST(TruthLines, HoldTheMarkings) {
  Road truth;
  truth.markings = {{7, MarkingType::stopline, MarkingStyle::unknown, {{0, 0, 0}, {0, 3, 0}}}};
  const std::vector<KindLine> lines = kind_lines(truth);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].kind, LineKind::stopline);
}

TEST(DetectionLines, AreInTheMapFrameAndSureEnough) {
  DetectionFrame frame;
  frame.detections = {{MarkingType::roadedge, MarkingStyle::unknown, 0.3, {{1, 2, 3}, {4, 2, 3}}, {}},
                      {MarkingType::roadedge, MarkingStyle::unknown, 0.29, {{1, 2, 3}, {4, 2, 3}}, {}}};
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  T_map_body.translate(Point(10, 20, 30));
  const std::vector<KindLine> lines = kind_lines(frame, T_map_body, 0.3);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].kind, LineKind::roadedge);
  EXPECT_TRUE(lines[0].points[0].isApprox(Point(11, 22, 33)));
}

TEST(MapLines, AreBoundariesStoplinesAndLanes) {
  LocalMap map;
  map.boundaries.resize(2);
  map.boundaries[1].type = MarkingType::roadedge;
  map.stoplines.resize(1);
  map.stoplines[0].marking.type = MarkingType::stopline;
  map.lanes.resize(1);
  map.instances.resize(5);
  std::vector<LineKind> kinds;
  for (const KindLine& line : kind_lines(map)) kinds.push_back(line.kind);
  EXPECT_THAT(kinds, testing::ElementsAre(LineKind::laneline, LineKind::roadedge, LineKind::stopline,
                                          LineKind::lane));
}

}  // namespace
}  // namespace laneloom
