#include "mapping/lanes/unmarked_roads.hpp"

#include <gmock/gmock.h>

#include "mapping/lanes/inferred_memory.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/lanes/lanes.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::boundary;
using test::straight;

boundaries::LaneBoundary road_edge(ElementId id, double y, double from_x = 0.0, double to_x = 60.0) {
  return boundary(id, straight({from_x, y, 0}, {to_x, y, 0}), MarkingType::roadedge);
}

boundaries::LaneBoundary road_line(ElementId id, double y, double from_x = 0.0, double to_x = 60.0) {
  return boundary(id, straight({from_x, y, 0}, {to_x, y, 0}));
}

/// A road that is mapped frame by frame.
class Dividers : public ::testing::Test {
 protected:
  /// Boundaries that run forward.
  void map(std::vector<boundaries::LaneBoundary> boundaries) {
    ++frame_;
    memory_.recognise(std::vector<Marking>{}, test::scene(frame_), ids_);  // no edge is continued
    boundaries::SectionGraph graph = road_sections(std::move(boundaries), test::at(0), {});
    const auto pairs = boundary_pairs(graph);
    auto lanes = generate_lanes(pairs, graph.boundaries, Point::Zero(), config_);
    TakenSpace taken(lanes);
    auto inferred = divide_unmarked(pairs, graph.boundaries, config_, taken);
    lay_out({std::move(graph.boundaries), std::move(lanes), std::move(inferred)});
  }

  void lay_out(FoundLanes found) {
    LaneLayout layout =
        tracks_.adopt(memory_.recognise(std::move(found), test::scene(frame_), config_, ids_), ids_);
    boundaries_ = std::move(layout.boundaries);
    lanes_ = std::move(layout.lanes);
  }

  std::vector<Lane> inferred() const {
    std::vector<Lane> lanes;
    std::ranges::copy_if(lanes_, std::back_inserter(lanes),
                         [](const Lane& lane) { return lane.status == ElementStatus::inferred; });
    return lanes;
  }

  /// The only divider, which has to be there.
  const Marking& divider() const {
    const auto found = std::ranges::find(boundaries_, ElementStatus::inferred,
                                         [](const boundaries::LaneBoundary& b) { return b.marking.status; });
    if (found == boundaries_.end()) throw std::logic_error("no divider");
    return found->marking;
  }

  LaneConfig config_;
  std::uint64_t frame_ = 0;
  markings::IdSource ids_{100};
  InferredMemory memory_;
  LaneTracks tracks_;
  boundaries::Boundaries boundaries_;
  std::vector<Lane> lanes_;
};

TEST_F(Dividers, TwoLanesFillARoadWithoutALine) {
  map({road_edge(1, 9), road_edge(2, 0)});
  ASSERT_EQ(lanes_.size(), 2U);
  ASSERT_EQ(inferred().size(), 2U);
  const Lane &left = lanes_[0], &right = lanes_[1];
  EXPECT_EQ(left.left_borders.front().boundary, 1U);
  EXPECT_EQ(left.right_borders.front().boundary, right.left_borders.front().boundary);
  EXPECT_EQ(right.right_borders.front().boundary, 2U);
  EXPECT_NEAR(left.width_m, 4.5, 1e-9);
  EXPECT_NEAR(right.width_m, 4.5, 1e-9);
  for (const Point& point : left.centerline) EXPECT_NEAR(point.y(), 6.75, 1e-9);
  for (const Point& point : right.centerline) EXPECT_NEAR(point.y(), 2.25, 1e-9);
  for (const Lane& lane : lanes_) {
    ASSERT_EQ(lane.inferred_ranges.size(), 1U);
    EXPECT_NEAR(lane.inferred_ranges[0].length(), 60.0, 1e-6);
  }
}

TEST_F(Dividers, SayThatNothingIsPaintedThere) {
  map({road_edge(1, 9), road_edge(2, 0)});
  EXPECT_EQ(divider().type, MarkingType::laneline);
  EXPECT_EQ(divider().first_seen_ns, 1);
  EXPECT_EQ(divider().observations, 0U);
  ASSERT_EQ(divider().styles.size(), 1U);
  EXPECT_EQ(divider().styles[0].style, MarkingStyle::unknown);
  EXPECT_NEAR(divider().styles[0].range.to_m, 60.0, 1e-6);
}

TEST_F(Dividers, AreNotSaidToBeLikely) {
  std::vector<boundaries::LaneBoundary> edges{road_edge(1, 9), road_edge(2, 0)};
  for (boundaries::LaneBoundary& edge : edges) edge.marking.existence_probability = 0.9;
  map(edges);
  EXPECT_EQ(divider().existence_probability, -1.0);
  for (const Lane& lane : lanes_) EXPECT_EQ(lane.existence_probability, -1.0);
}

TEST_F(Dividers, NeedRoomForTwoLanes) {
  const auto lanes_between = [this](boundaries::LaneBoundary left, boundaries::LaneBoundary right) {
    map({std::move(left), std::move(right)});
    return inferred().size();
  };
  EXPECT_EQ(lanes_between(road_edge(1, 6.4), road_edge(2, 0)), 0U);
  EXPECT_EQ(lanes_between(road_edge(1, 6.6), road_edge(2, 0)), 2U);
  EXPECT_EQ(lanes_between(road_edge(1, 12.9), road_edge(2, 0)), 2U) << "with room to park on both sides";
  EXPECT_EQ(lanes_between(road_edge(1, 13.1), road_edge(2, 0)), 0U);
  EXPECT_EQ(lanes_between(road_line(1, 8.9), road_edge(2, 0)), 2U);
  EXPECT_EQ(lanes_between(road_line(1, 9.1), road_edge(2, 0)), 0U) << "beside a line, three lanes";
  EXPECT_EQ(lanes_between(road_line(1, 8), road_line(2, 0)), 0U) << "between lines, a median";
  EXPECT_EQ(lanes_between(road_edge(1, 9, 0, 7.5), road_edge(2, 0)), 0U) << "too short";
  config_.unmarked_roads = false;
  EXPECT_EQ(lanes_between(road_edge(1, 9), road_edge(2, 0)), 0U) << "turned off";
}

TEST_F(Dividers, NeedConfirmedBoundaries) {
  std::vector<boundaries::LaneBoundary> edges{road_edge(1, 9), road_edge(2, 0)};
  edges[0].marking.status = ElementStatus::tentative;
  map(edges);
  EXPECT_TRUE(lanes_.empty());
}

TEST_F(Dividers, AreNotWhereAnotherBoundaryIs) {
  // Too far from the edges for lanes of so little length.
  const boundaries::LaneBoundary edges[]{road_edge(1, 12), road_edge(2, 0)};
  const auto lanes_with = [&](boundaries::LaneBoundary middle, ElementStatus status) {
    middle.marking.status = status;
    map({edges[0], edges[1], middle});
    return inferred().size();
  };
  EXPECT_EQ(lanes_with(road_line(3, 6, 26, 34), ElementStatus::confirmed), 4U)
      << "before and behind the line";
  EXPECT_EQ(lanes_with(road_line(3, 6, 26, 34), ElementStatus::tentative), 2U);
  EXPECT_EQ(lanes_with(road_edge(3, 6, 26, 34), ElementStatus::confirmed), 4U) << "an island";
  EXPECT_EQ(lanes_with(road_edge(3, 6, 26, 34), ElementStatus::tentative), 4U) << "maybe an island";
  EXPECT_EQ(lanes_with(boundary(3, straight({30, 2, 0}, {30, 10, 0})), ElementStatus::confirmed), 2U)
      << "a line across the road divides nothing";
}

TEST_F(Dividers, DoNotCountALineAlongAnEdgeAsOne) {
  map({road_edge(1, 9), road_edge(2, 0), road_line(3, 0.5)});
  EXPECT_EQ(inferred().size(), 2U);
  map({road_edge(1, 9), road_edge(2, 0), road_line(3, 0.5), road_line(4, 8.5)});
  EXPECT_EQ(inferred().size(), 2U) << "neither twice";
}

TEST_F(Dividers, AreNotInAMedian) {
  const auto road = [this](double from_y, double to_y) {  // a lane beyond either edge
    map({road_line(1, 12), road_line(2, to_y), road_edge(3, 8), road_edge(4, 0), road_line(5, from_y),
         road_line(6, -4)});
    EXPECT_EQ(lanes_.size(), 2U + inferred().size());
    return inferred().size();
  };
  EXPECT_EQ(road(-0.4, 8.4), 0U) << "lines along its edges";
  EXPECT_EQ(road(0.0, 8.0), 0U);
}

TEST_F(Dividers, DoNotCrossAKerb) {
  map({road_edge(1, 11.2), road_line(2, 8), road_edge(3, 7.6), road_edge(4, 0), road_line(5, -3.2)});
  EXPECT_TRUE(inferred().empty());
}

TEST_F(Dividers, LieBetweenBoundariesThatRunAgainstEachOther) {
  boundaries::SectionGraph graph{.boundaries = std::vector{road_edge(1, 9), road_edge(2, 0)},
                                 .sections = {{{0, 1}}},
                                 .beside = {{{1, 9.0, 60.0, true}}, {{0, 9.0, 60.0, true}}}};
  graph.boundaries.reverse(0);
  TakenSpace taken(lanes_);
  auto dividers = divide_unmarked(boundary_pairs(graph), graph.boundaries, config_, taken);
  ASSERT_EQ(dividers.size(), 1U);
  lay_out({std::move(graph.boundaries), {}, std::move(dividers)});
  ASSERT_EQ(lanes_.size(), 2U);
  for (const Lane& lane : lanes_) {
    EXPECT_NEAR(lane.width_m, 4.5, 1e-9);
    EXPECT_LT(MeasuredPolyline(lane.left).project(lane.right[20]).lateral_m, 0.0);
    EXPECT_NEAR(lane.left_borders.front().on_boundary.length(), 60.0, 1e-6);
    EXPECT_NEAR(lane.right_borders.front().on_boundary.length(), 60.0, 1e-6);
  }
}

TEST_F(Dividers, FollowABend) {
  const Point centre(0, 40, 0);
  map({boundary(1, test::arc(centre, 31, -90, 0), MarkingType::roadedge),
       boundary(2, test::arc(centre, 40, -90, 0), MarkingType::roadedge)});
  ASSERT_EQ(inferred().size(), 2U);
  for (const Point& point : divider().points) EXPECT_NEAR((point - centre).norm(), 35.5, 0.05);
}

TEST_F(Dividers, EndWhereTheRoadOpensIntoAnIntersection) {
  const auto turning_off = [](ElementId id, double y, const Polyline& corner) {
    boundaries::LaneBoundary edge = boundary(id, straight({0, y, 0}, {40, y, 0}, 41), MarkingType::roadedge);
    edge.marking.points.insert(edge.marking.points.end(), corner.begin() + 1, corner.end());
    return edge;
  };
  map({turning_off(1, 9, test::arc({40, 17, 0}, 8, -90, -10)),
       turning_off(2, 0, test::arc({40, -8, 0}, 8, 90, 10))});
  ASSERT_EQ(inferred().size(), 2U);
  EXPECT_NEAR(divider().points.front().x(), 0.0, 1e-6);
  EXPECT_NEAR(divider().points.back().x(), 41.0, 1.0);
}

TEST_F(Dividers, ContinueALineThatEnds) {
  map({road_edge(1, 9), road_edge(2, 0), road_line(3, 5.5, 0, 20)});
  EXPECT_EQ(lanes_.size(), 4U);
  ASSERT_EQ(inferred().size(), 2U);
  for (const Point& point : divider().points) EXPECT_NEAR(point.y(), 5.5, 1e-9);
  EXPECT_NEAR(divider().points.front().x(), 20.0, 1.5);
}

TEST_F(Dividers, LeadFromOneLineToTheNext) {
  map({road_edge(1, 9), road_edge(2, 0), road_line(3, 5.5, 0, 20), road_line(4, 3.5, 40, 60)});
  ASSERT_EQ(inferred().size(), 2U);
  EXPECT_NEAR(divider().points.front().y(), 5.5, 1e-9);
  EXPECT_NEAR(divider().points.back().y(), 3.5, 1e-9);
}

TEST_F(Dividers, LeaveNoLaneTooNarrowOrTooWide) {
  map({road_edge(1, 8), road_edge(2, 0), road_line(3, 1.5, 0, 20)});
  EXPECT_TRUE(inferred().empty()) << "1.5 m";
  map({road_edge(1, 12), road_edge(2, 0), road_line(3, 2.5, 0, 20)});
  EXPECT_TRUE(inferred().empty()) << "9.5 m";
}

TEST_F(Dividers, BeyondTheEdgeOfARoadWithLanesAreNone) {
  map({road_line(1, 12.5), road_edge(2, 9), road_edge(3, 0)});
  EXPECT_EQ(lanes_.size(), 1U);
  EXPECT_TRUE(inferred().empty());
}

TEST_F(Dividers, OfTwoRoadsWithACommonEdgeAreTwo) {
  map({road_edge(1, 16), road_edge(2, 8), road_edge(3, 0)});
  EXPECT_EQ(inferred().size(), 4U);
}

TEST_F(Dividers, DoNotTakeAnIdForAPointInCommon) {
  map({road_edge(1, 9), road_edge(2, 0)});
  const ElementId id = divider().id;
  map({road_edge(1, 9, 57, 117), road_edge(2, 0, 57, 117)});
  EXPECT_NE(divider().id, id);
}

TEST_F(Dividers, AreOfTwoWaysBetweenKerbsOnly) {
  const auto two_way = [this] {
    return std::ranges::any_of(boundaries_, [](const boundaries::LaneBoundary& b) { return b.two_way; });
  };
  map({road_edge(1, 9), road_edge(2, 0)});
  EXPECT_TRUE(two_way());
  map({road_edge(1, 9.5), road_line(2, 9), road_line(3, 0.5), road_edge(4, 0)});
  EXPECT_TRUE(two_way());
  map({road_line(1, 8), road_edge(2, 0)});
  ASSERT_EQ(inferred().size(), 2U);
  EXPECT_FALSE(two_way());
}

TEST_F(Dividers, KeepTheirIdAsTheWindowMoves) {
  map({road_edge(1, 9), road_edge(2, 0)});
  const ElementId id = divider().id;
  map({road_edge(1, 9.2, 10, 70), road_edge(2, 0.2, 10, 70)});
  EXPECT_EQ(divider().id, id);
  EXPECT_EQ(divider().first_seen_ns, 1);
  map({road_edge(1, 9, 200, 260), road_edge(2, 0, 200, 260)});
  EXPECT_NE(divider().id, id);
}

TEST_F(Dividers, OnTheBridgeIsAnotherThanBelow) {
  map({road_edge(1, 9), road_edge(2, 0)});
  const ElementId id = divider().id;
  std::vector<boundaries::LaneBoundary> above{road_edge(1, 9), road_edge(2, 0)};
  for (boundaries::LaneBoundary& boundary : above)
    for (Point& point : boundary.marking.points) point.z() = 6.0;
  map(above);
  EXPECT_NE(divider().id, id);
}

TEST_F(Dividers, KeepTheirIdsFromFrameToFrameHoweverShortTheMemory) {
  config_.id_memory_frames = 0;
  map({road_edge(1, 9), road_edge(2, 0)});
  const ElementId id = divider().id;
  map({road_edge(1, 9), road_edge(2, 0)});
  EXPECT_EQ(divider().id, id);
}

TEST_F(Dividers, AreForgottenAfterAWhile) {
  map({road_edge(1, 9), road_edge(2, 0)});
  const ElementId id = divider().id;
  for (int i = 0; i <= config_.id_memory_frames; ++i) map({});
  map({road_edge(1, 9), road_edge(2, 0)});
  EXPECT_NE(divider().id, id);
}

TEST_F(Dividers, AreAmongTheBoundariesByTheirId) {
  map({road_edge(1, 9), road_edge(2, 0)});
  map({road_edge(1, 9), road_edge(200, 0)});
  std::vector<ElementId> ids;
  for (const boundaries::LaneBoundary& boundary : boundaries_) ids.push_back(boundary.marking.id);
  EXPECT_THAT(ids, testing::ElementsAre(1U, 100U, 200U));
  for (const boundaries::LaneBoundary& boundary : boundaries_)
    EXPECT_EQ(boundary.course.points().front(), boundary.marking.points.front());
}

}  // namespace
}  // namespace laneloom::lanes
