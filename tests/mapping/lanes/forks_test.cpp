#include "mapping/lanes/forks.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "mapping/geometry/stretches.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/lanes/paper_lanes.hpp"
#include "mapping/shapes.hpp"
#include "mapping/topology/directions.hpp"
#include "mapping/topology/linkages.hpp"

namespace laneloom::lanes {
namespace {

using test::boundary;
using test::straight;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;
using ::testing::UnorderedElementsAreArray;

/// 0 up to `from_x`, 1 from `from_x` + 15 on.
double eased(double x, double from_x = 30.0) { return std::clamp((x - from_x) / 15.0, 0.0, 1.0); }

/// A line along x, 60 m long, that moves to the left by `by_m` after 30 m.
boundaries::LaneBoundary line(ElementId id, double y, double by_m = 0.0) {
  Polyline points = straight({0, y, 0}, {60, y, 0}, 121);
  for (Point& point : points) point.y() += by_m * eased(point.x());
  return boundary(id, points);
}

/// The part of a line from `from_x` on.
boundaries::LaneBoundary from(double from_x, boundaries::LaneBoundary line) {
  std::erase_if(line.marking.points, [&](const Point& point) { return point.x() < from_x; });
  return line;
}

/// Turns a road round, so that what opened closes.
std::vector<boundaries::LaneBoundary> mirrored(std::vector<boundaries::LaneBoundary> lines) {
  for (boundaries::LaneBoundary& line : lines) {
    for (Point& point : line.marking.points) point.x() = 60.0 - point.x();
    std::ranges::reverse(line.marking.points);
  }
  return lines;
}

/// The ids of the boundaries of the lanes that a linkage joins: of the first one left and right, of the
/// second one left and right.
using Joined = std::array<ElementId, 4>;

/// A road that is mapped.
class Forks : public ::testing::Test {
 protected:
  /// Lets the boundary of one id run against the lanes, if `against` is one.
  void map(std::vector<boundaries::LaneBoundary> lines, ElementId against = kNoElement) {
    boundaries::SectionGraph graph = road_sections(std::move(lines), test::at(0), {});
    LaneLayout layout;
    layout.lanes = paper_lanes(graph, {}).lanes;
    if (against != kNoElement) reverse(against, graph.boundaries, layout.lanes);
    layout.forks = cut_at_forks(graph.boundaries, {}, layout.lanes);
    forks_ = layout.forks.size();
    ElementId id = 100;
    for (Lane& lane : layout.lanes) lane.id = id++;
    layout.boundaries = std::move(graph.boundaries);
    road_ = topology::link_lanes(std::move(layout), {});
  }

  static void reverse(ElementId id, boundaries::Boundaries& boundaries, std::vector<Lane>& lanes) {
    const double length_m = boundaries.of(id).course.length();
    boundaries.reverse(boundaries.index_of(id));
    for (Lane& lane : lanes) {
      for (const auto& [boundary, range, reversed] :
           {std::tuple(lane.left_borders.front().boundary, &lane.left_borders.front().on_boundary,
                       &lane.left_borders.front().reversed),
            std::tuple(lane.right_borders.front().boundary, &lane.right_borders.front().on_boundary,
                       &lane.right_borders.front().reversed)}) {
        if (boundary != id) continue;
        *range = geometry::reversed(*range, length_m);
        *reversed = !*reversed;
      }
    }
  }

  std::vector<Joined> joined() const {
    std::vector<Joined> result;
    for (const Linkage& linkage : road_.linkages) {
      const Lane &a = road_.lane(linkage.from), &b = road_.lane(linkage.to);
      result.push_back({a.left_borders.front().boundary, a.right_borders.front().boundary,
                        b.left_borders.front().boundary, b.right_borders.front().boundary});
    }
    return result;
  }

  std::vector<const Lane*> between(ElementId left, ElementId right) const {
    std::vector<const Lane*> found;
    for (const Lane& lane : road_.lanes)
      if (lane.left_borders.front().boundary == left && lane.right_borders.front().boundary == right)
        found.push_back(&lane);
    std::ranges::sort(found, {}, [](const Lane* lane) { return lane->centerline.front().x(); });
    return found;
  }

  std::size_t forks_ = 0;
  topology::RoadGraph road_;
};

/// A lane between 2 and 3 gives way to the right, and a lane between 1 and 2 opens on its left.
std::vector<boundaries::LaneBoundary> pocket() {
  return {from(30, line(1, 0.1)), line(2, 0, -3), line(3, -3.5, -3)};
}

TEST_F(Forks, ALaneThatGivesWayIsCutWhereTheOtherOpens) {
  map(pocket());
  const auto stem = between(2, 3);
  ASSERT_EQ(stem.size(), 2U);
  EXPECT_NEAR(stem[0]->centerline.back().x(), 31.0, 2.0);
  EXPECT_TRUE(stem[0]->centerline.back().isApprox(stem[1]->centerline.front()));
  EXPECT_TRUE(stem[0]->left.back().isApprox(stem[1]->left.front()));
  EXPECT_TRUE(stem[0]->right.back().isApprox(stem[1]->right.front()));
  EXPECT_EQ(stem[0]->left_borders.front().on_boundary.to_m, stem[1]->left_borders.front().on_boundary.from_m);
  EXPECT_EQ(stem[0]->right_borders.front().on_boundary.to_m,
            stem[1]->right_borders.front().on_boundary.from_m);
  EXPECT_NEAR(stem[0]->left_borders.front().on_boundary.from_m, 0.0, 1.0);
  EXPECT_THAT(joined(), UnorderedElementsAre(Joined{2, 3, 2, 3}, Joined{2, 3, 1, 2}));
}

TEST_F(Forks, TheWayIntoTheBranchLeadsFromTheStemToItsBegin) {
  map(pocket());
  const auto to_branch =
      std::ranges::find_if(road_.linkages, [](const Linkage& linkage) { return !linkage.path.empty(); });
  ASSERT_NE(to_branch, road_.linkages.end());
  EXPECT_TRUE(to_branch->path.front().isApprox(between(2, 3)[0]->centerline.back()));
  EXPECT_TRUE(to_branch->path.back().isApprox(between(1, 2)[0]->centerline.front()));
}

TEST_F(Forks, ALaneThatClosesLeadsIntoTheLaneThatTakesItsRoom) {
  map(mirrored(pocket()));
  EXPECT_EQ(forks_, 1U);
  EXPECT_THAT(joined(), UnorderedElementsAre(Joined{2, 3, 2, 3}, Joined{1, 2, 2, 3}));
}

TEST_F(Forks, TheStemIsTheLaneThatGivesWay) {
  auto lines = pocket();
  lines.push_back(line(4, 3.5));
  map(lines);
  EXPECT_EQ(between(2, 3).size(), 2U);
  EXPECT_THAT(joined(), Contains(Joined{2, 3, 1, 2}));
  EXPECT_THAT(joined(), Not(Contains(Joined{4, 2, 1, 2})));
}

TEST_F(Forks, TheBranchRunsAsItsStemDoesAndNotAsTheLaneBeyondIt) {
  auto lines = pocket();
  lines.push_back(line(4, 3.5));
  map(lines);
  std::vector<LaneTrack> tracks;
  for (const Lane& lane : road_.lanes) tracks.push_back({.id = lane.id});
  LaneTracks known(std::move(tracks));
  known.find(between(2, 3)[0]->id)->direction_log_odds = 6.0;
  topology::find_directions({}, {topology::side_by_side(road_), {}}, known, road_);
  EXPECT_EQ(between(1, 2)[0]->direction, Lane::Direction::along_centerline);
  const std::vector<const Lane*> beyond = between(4, 2);
  ASSERT_EQ(beyond.size(), 1U);
  EXPECT_EQ(beyond[0]->direction, Lane::Direction::unknown);
}

TEST_F(Forks, AreTheSameBesideABoundaryThatRunsAgainstTheLanes) {
  for (const auto& lines : {pocket(), mirrored(pocket())}) {
    map(lines);
    const std::vector<Joined> expected = joined();
    const double end_m = between(2, 3)[0]->centerline.back().x();
    for (const ElementId against : {1U, 2U, 3U}) {
      map(lines, against);
      EXPECT_EQ(forks_, 1U);
      EXPECT_THAT(joined(), UnorderedElementsAreArray(expected));
      ASSERT_EQ(between(2, 3).size(), 2U);
      EXPECT_NEAR(between(2, 3)[0]->centerline.back().x(), end_m, 0.5);
      for (const Lane* lane : between(2, 3)) EXPECT_GT(lane->left_borders.front().on_boundary.length(), 20.0);
    }
  }
}

TEST_F(Forks, TheBranchIsTheLaneAheadOfTheTip) {
  auto lines = pocket();
  lines.push_back(from(25, line(4, 3.5)));  // a lane beside its end begins nearer to the tip, and before it
  map(lines);
  EXPECT_THAT(joined(), Contains(Joined{2, 3, 1, 2}));
  EXPECT_THAT(joined(), Not(Contains(Joined{2, 3, 4, 2})));
}

// The lane in the middle may be one of either direction.
TEST_F(Forks, BetweenLanesThatGiveWayAlikeNoneIsFound) {
  map({from(30, line(1, 0.1, 1.5)), line(2, 0, -1.5), line(3, -3.5, -1.5), line(4, 3.6, 1.5)});
  EXPECT_EQ(forks_, 0U);
}

TEST_F(Forks, LanesThatBeginBesideOthersWithTheirFullWidthHaveNone) {
  map({from(30, line(1, 3.3)), line(2, 0), line(3, -3.5)});
  EXPECT_EQ(forks_, 0U);
  EXPECT_EQ(between(2, 3).size(), 1U);
  EXPECT_THAT(joined(), IsEmpty());
}

TEST_F(Forks, PartsThatAreTooShortAreNotCutOff) {
  auto lines = pocket();
  lines[2] = from(28, std::move(lines[2]));  // the lane begins just before the other one
  map(lines);
  EXPECT_EQ(forks_, 0U);
  EXPECT_EQ(between(2, 3).size(), 1U);
  lines = pocket();
  std::erase_if(lines[2].marking.points, [](const Point& point) { return point.x() > 33.0; });
  map(lines);
  EXPECT_EQ(between(2, 3).size(), 1U);
  EXPECT_THAT(joined(), Contains(Joined{2, 3, 1, 2}));
}

TEST_F(Forks, InferredStretchesStayWhereTheyAre) {
  auto lines = pocket();
  lines[2].bridged = {{28.0, 40.0}};
  map(lines);
  const auto stem = between(2, 3);
  ASSERT_EQ(stem.size(), 2U);
  for (const Lane* lane : stem) ASSERT_EQ(lane->inferred_ranges.size(), 1U);
  EXPECT_NEAR(stem[0]->inferred_ranges[0].to_m, length(stem[0]->centerline), 1e-9);
  EXPECT_EQ(stem[1]->inferred_ranges[0].from_m, 0.0);
  EXPECT_NEAR(stem[0]->inferred_ranges[0].length() + stem[1]->inferred_ranges[0].length(), 12.0, 2.0);
}

}  // namespace
}  // namespace laneloom::lanes
