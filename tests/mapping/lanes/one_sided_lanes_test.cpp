#include "mapping/lanes/one_sided_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mapping/lanes/inferred_memory.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::straight;

boundaries::LaneBoundary styled(ElementId id, const Polyline& points, MarkingStyle style) {
  boundaries::LaneBoundary boundary = test::boundary(id, points);
  boundary.marking.styles = {{{0.0, length(points)}, style}};
  return boundary;
}
boundaries::LaneBoundary dashed(ElementId id, double y, double from_x = 0.0, double to_x = 40.0) {
  return styled(id, straight({from_x, y, 0}, {to_x, y, 0}), MarkingStyle::dashed);
}
boundaries::LaneBoundary solid(ElementId id, double y) {
  return styled(id, straight({0, y, 0}, {40, y, 0}), MarkingStyle::solid);
}
boundaries::LaneBoundary edge(ElementId id, double y, double from_x = 0.0, double to_x = 40.0) {
  return test::boundary(id, straight({from_x, y, 0}, {to_x, y, 0}), MarkingType::roadedge);
}

/// Seen from a vehicle; far from all, if it is not said where it is.
class OneSidedLanes : public ::testing::Test {
 protected:
  void map(std::vector<boundaries::LaneBoundary> boundaries,
           const Eigen::Isometry3d& vehicle = test::at(10, 9)) {
    boundaries::RoadSection all;
    for (std::size_t i = 0; i < boundaries.size(); ++i) all.boundaries.push_back(i);
    boundaries::SectionGraph road{.boundaries = std::move(boundaries), .sections = {all}, .beside = {}};
    TakenSpace taken(known_lanes_);
    auto inferred = one_sided_lanes(road, geometry::MapBox(range_, vehicle), config_, taken);
    memory_.identify(markings_of(inferred), test::scene(++frame_), ids_);
    LaneLayout layout = laid_out({std::move(road.boundaries), known_lanes_, std::move(inferred)});
    boundaries_ = std::move(layout.boundaries);
    lanes_ = std::move(layout.lanes);
    lanes_.erase(lanes_.begin(), lanes_.begin() + static_cast<std::ptrdiff_t>(known_lanes_.size()));
  }
  std::size_t lanes_with(std::vector<boundaries::LaneBoundary> boundaries,
                         const Eigen::Isometry3d& vehicle = test::at(10, 9)) {
    map(std::move(boundaries), vehicle);
    return lanes_.size();
  }

  LaneConfig config_;
  RangeConfig range_{.forward_min_m = -60.0, .forward_max_m = 60.0, .side_max_m = 20.0};
  std::vector<Lane> known_lanes_;
  std::vector<Lane> lanes_;  ///< those beside one line
  boundaries::Boundaries boundaries_;
  InferredMemory memory_;
  std::uint64_t frame_ = 0;
  markings::IdSource ids_{100};
};

TEST_F(OneSidedLanes, LieOnBothSidesOfADashedLine) {
  map({dashed(1, 0)});
  ASSERT_EQ(lanes_.size(), 2U);
  const Lane &right = lanes_[0], &left = lanes_[1];
  EXPECT_EQ(right.left_borders.front().boundary, 1U);
  EXPECT_EQ(left.right_borders.front().boundary, 1U);
  EXPECT_NE(left.left_borders.front().boundary, right.right_borders.front().boundary);
  for (const Point& point : right.centerline) EXPECT_NEAR(point.y(), -1.65, 1e-9);
  for (const Point& point : left.centerline) EXPECT_NEAR(point.y(), 1.65, 1e-9);
  for (const Lane& lane : lanes_) {
    EXPECT_NEAR(lane.width_m, 3.3, 1e-9);
    EXPECT_NEAR(length(lane.centerline), 40.0, 1e-6);
    EXPECT_NEAR(lane.left_borders.front().on_boundary.length(), 40.0, 1e-6);
    EXPECT_NEAR(lane.right_borders.front().on_boundary.length(), 40.0, 1e-6);
    EXPECT_EQ(lane.status, ElementStatus::inferred);
    EXPECT_EQ(lane.existence_probability, -1.0);
    ASSERT_EQ(lane.inferred_ranges.size(), 1U);
    EXPECT_NEAR(lane.inferred_ranges[0].length(), 40.0, 1e-6);
  }
  ASSERT_EQ(boundaries_.size(), 3U);
  for (std::size_t i = 1; i < 3; ++i) EXPECT_EQ(boundaries_[i].marking.status, ElementStatus::inferred);
}

TEST_F(OneSidedLanes, LieBesideASolidLineWhereTheVehicleDrives) {
  const auto lanes_from = [this](const Eigen::Isometry3d& vehicle) {
    return lanes_with({solid(1, 0)}, vehicle);
  };
  EXPECT_EQ(lanes_from(test::at(10, 9)), 0U);
  ASSERT_EQ(lanes_from(test::at(10, 1.5)), 1U);
  EXPECT_EQ(lanes_[0].right_borders.front().boundary, 1U);
  ASSERT_EQ(lanes_from(test::at(10, -1.5)), 1U);
  EXPECT_EQ(lanes_[0].left_borders.front().boundary, 1U);
  EXPECT_EQ(lanes_from(test::at(10, 0.7)), 0U) << "changing lanes";
  EXPECT_EQ(lanes_from(test::at(10, 2.6)), 0U) << "in another lane";
  EXPECT_EQ(lanes_from(test::at(-9, 1.5)), 1U) << "the line begins ahead";
  EXPECT_EQ(lanes_from(test::at(-11, 1.5)), 0U);
  EXPECT_EQ(lanes_from(test::at(10, 1.5, 1.0)), 0U) << "across the line";
  EXPECT_EQ(lanes_from(Eigen::Translation3d(0, 0, 6) * test::at(10, 1.5)), 0U) << "on a bridge above";
}

TEST_F(OneSidedLanes, LieBesideAnEdgeWhereTheVehicleDrives) {
  map({edge(1, 0)}, test::at(10, 1.6));
  ASSERT_EQ(lanes_.size(), 1U);
  EXPECT_EQ(lanes_[0].right_borders.front().boundary, 1U);
  for (const Point& point : lanes_[0].centerline) EXPECT_NEAR(point.y(), 1.65, 1e-9);
  EXPECT_EQ(lanes_with({edge(1, 0)}), 0U) << "the vehicle is far from it";
}

TEST_F(OneSidedLanes, AreNotBesideAnEdgeOfAMarkedRoad) {
  EXPECT_EQ(lanes_with({edge(1, 0), solid(2, 12)}, test::at(10, 1.6)), 0U);
  boundaries::LaneBoundary unsure = solid(2, 12);
  unsure.marking.status = ElementStatus::tentative;
  EXPECT_EQ(lanes_with({edge(1, 0), unsure}, test::at(10, 1.6)), 1U);
}

TEST_F(OneSidedLanes, EndWithTheDashes) {
  boundaries::LaneBoundary line = dashed(1, 0);
  line.marking.styles = {{{0, 20}, MarkingStyle::dashed}, {{20, 40}, MarkingStyle::solid}};
  map({line});
  ASSERT_EQ(lanes_.size(), 2U);
  for (const Lane& lane : lanes_) EXPECT_NEAR(length(lane.centerline), 20.0, 1.0);
}

TEST_F(OneSidedLanes, DoNotMindShortPatchesOfAnotherStyle) {
  boundaries::LaneBoundary line = dashed(1, 0);
  line.marking.styles = {{{0, 12}, MarkingStyle::dashed},
                         {{12, 20}, MarkingStyle::unknown},
                         {{20, 26}, MarkingStyle::dashed},
                         {{26, 29}, MarkingStyle::solid},
                         {{29, 40}, MarkingStyle::dashed}};
  map({line});
  ASSERT_EQ(lanes_.size(), 2U);
  for (const Lane& lane : lanes_) EXPECT_NEAR(length(lane.centerline), 40.0, 0.1);
}

TEST_F(OneSidedLanes, AreNotInAGapOfAnEdge) {
  const auto lanes_beside = [this](double gap_m) {
    return lanes_with(
        {dashed(1, 0, 0, 60), edge(2, 1.5, 0, 20), edge(3, 1.5, 20 + gap_m, 60), edge(4, -1.5, 0, 60)});
  };
  EXPECT_EQ(lanes_beside(15), 0U);
  EXPECT_EQ(lanes_beside(25), 1U);
}

TEST_F(OneSidedLanes, AreNotWhereTheirLineComesBack) {
  Polyline hairpin = straight({0, 0, 0}, {20, 0, 0}, 21);
  const Polyline turn = test::arc({20, 2.5, 0}, 2.5, -90, 90), back = straight({20, 5, 0}, {0, 5, 0}, 21);
  hairpin.insert(hairpin.end(), turn.begin() + 1, turn.end());
  hairpin.insert(hairpin.end(), back.begin() + 1, back.end());
  map({styled(1, hairpin, MarkingStyle::dashed)});
  for (const Lane& lane : lanes_) EXPECT_EQ(lane.left_borders.front().boundary, 1U) << "outside";
  EXPECT_FALSE(lanes_.empty());
}

TEST_F(OneSidedLanes, AreAsWideOnASlope) {
  map({styled(1, straight({0, 0, 0}, {40, 0, 20}), MarkingStyle::dashed)});
  ASSERT_EQ(lanes_.size(), 2U);
  for (const Point& point : lanes_[0].right) EXPECT_NEAR(point.y(), -3.3, 1e-9);
}

TEST_F(OneSidedLanes, NeedRoomThatNothingElseTakes) {
  const auto on_left_with = [this](boundaries::LaneBoundary other) {
    map({dashed(1, 0), std::move(other)});
    return std::ranges::count(lanes_, 1U,
                              [](const Lane& lane) { return lane.right_borders.front().boundary; });
  };
  EXPECT_EQ(on_left_with(edge(2, 6.6)), 1);
  EXPECT_EQ(on_left_with(edge(2, 6.4)), 0);
  EXPECT_EQ(on_left_with(edge(2, 0.3)), 0);
  EXPECT_EQ(on_left_with(solid(2, 5.0)), 0);
  boundaries::LaneBoundary tentative = solid(2, 5.0);
  tentative.marking.status = ElementStatus::tentative;
  EXPECT_EQ(on_left_with(tentative), 0) << "maybe there is something";
  boundaries::LaneBoundary above = edge(2, 3.0);
  for (Point& point : above.marking.points) point.z() = 6.0;
  EXPECT_EQ(on_left_with(above), 1) << "of a bridge";
  EXPECT_EQ(on_left_with(edge(2, 3.0, -20, -1)), 1) << "ends before";
  ASSERT_EQ(on_left_with(edge(2, 3.0, -20, 20)), 1);
  EXPECT_NEAR(length(lanes_[1].centerline), 20.0, 1.5) << "behind its end";
}

TEST_F(OneSidedLanes, AreNotWhereALaneIs) {
  known_lanes_.resize(1);
  Lane& lane = known_lanes_[0];
  lane.right_borders = {{.boundary = 1}};
  lane.left_borders = {{.boundary = 2}};
  lane.left_borders.front().on_boundary = lane.right_borders.front().on_boundary = {0, 40};
  lane.centerline = straight({0, 1.75, 0}, {40, 1.75, 0});
  lane.width_m = 3.5;
  map({dashed(1, 0)});
  ASSERT_EQ(lanes_.size(), 1U);
  EXPECT_EQ(lanes_[0].left_borders.front().boundary, 1U);
}

TEST_F(OneSidedLanes, OfTwoLinesDoNotOverlap) {
  map({dashed(1, 0), dashed(2, 6.6)});
  EXPECT_EQ(lanes_.size(), 4U);
  config_.assumed_width_m = 4.0;
  map({dashed(1, 0), dashed(2, 6.6)});
  EXPECT_EQ(lanes_.size(), 3U) << "between them there is room for one of these";
}

TEST_F(OneSidedLanes, NeedAConfirmedLine) {
  boundaries::LaneBoundary line = dashed(1, 0);
  line.marking.status = ElementStatus::tentative;
  EXPECT_EQ(lanes_with({line}), 0U);
  line = dashed(1, 0);
  line.marking.type = MarkingType::roadedge;
  EXPECT_EQ(lanes_with({line}), 0U);
}

TEST_F(OneSidedLanes, AreInTheRangeOnly) {
  EXPECT_EQ(lanes_with({dashed(1, -7.5)}), 2U);
  ASSERT_EQ(lanes_with({dashed(1, -8)}), 1U) << "20 m to the side of the vehicle";
  EXPECT_EQ(lanes_[0].right_borders.front().boundary, 1U);
}

TEST_F(OneSidedLanes, AreNoneBesideAShortLine) {
  EXPECT_EQ(lanes_with({dashed(1, 0, 0, 7.5)}), 0U);
  EXPECT_EQ(lanes_with({dashed(1, 0, 0, 8.5)}), 2U);
}

TEST_F(OneSidedLanes, FollowABendButDoNotFoldInIt) {
  map({styled(1, test::arc({0, 15, 0}, 15, -90, 0), MarkingStyle::dashed)});
  ASSERT_EQ(lanes_.size(), 2U);
  for (const Point& point : lanes_[0].centerline) EXPECT_NEAR((point - Point(0, 15, 0)).norm(), 16.65, 0.1);
  for (const Point& point : lanes_[1].centerline) EXPECT_NEAR((point - Point(0, 15, 0)).norm(), 13.35, 0.1);
  map({styled(1, test::arc({0, 4, 0}, 4, -90, 90), MarkingStyle::dashed)});
  ASSERT_EQ(lanes_.size(), 1U);
  EXPECT_EQ(lanes_[0].left_borders.front().boundary, 1U) << "outside";
}

TEST_F(OneSidedLanes, KeepTheirBoundariesIdsAsTheWindowMoves) {
  map({dashed(1, 0)});
  const ElementId right = lanes_[0].right_borders.front().boundary,
                  left = lanes_[1].left_borders.front().boundary;
  map({dashed(1, 0.2, 10, 50)});
  EXPECT_EQ(lanes_[0].right_borders.front().boundary, right);
  EXPECT_EQ(lanes_[1].left_borders.front().boundary, left);
  EXPECT_EQ(boundaries_[boundaries_.size() - 1].marking.first_seen_ns, 1);
}

TEST_F(OneSidedLanes, CanBeTurnedOff) {
  config_.one_sided_lanes = false;
  EXPECT_EQ(lanes_with({dashed(1, 0)}), 0U);
}

}  // namespace
}  // namespace laneloom::lanes
