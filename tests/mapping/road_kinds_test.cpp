// Roads as cars meet them, drawn line by line, and driven for some seconds with detections that do not err.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "laneloom/mapper.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

using testing::SizeIs;

struct Drawn {
  MarkingType type = MarkingType::laneline;
  double left_m = 0.0;  ///< of the vehicle
  MarkingStyle style = MarkingStyle::solid;
  double per_metre = 0.0;  ///< how much further on the left it lies, per metre of x in the map
  double up_m = 0.0;       ///< above the vehicle's origin
  double to_m = 1e6;       ///< it ends there, along the road
};

/// Places of a road that is straight along x, or bends to the left with a radius.
struct Road {
  double radius_m = 0.0;  ///< 0: it is straight

  Eigen::Isometry3d pose(double along_m) const {
    if (radius_m == 0.0) return Eigen::Isometry3d(Eigen::Translation3d(along_m, 0.0, 0.0));
    const Eigen::Translation3d center(0.0, radius_m, 0.0);
    return center * Eigen::AngleAxisd(along_m / radius_m, Eigen::Vector3d::UnitZ()) * center.inverse();
  }
  Point at(const Drawn& line, double along_m) const {
    return pose(along_m) * Point(0.0, line.left_m + line.per_metre * along_m, line.up_m);
  }
};

constexpr MarkingType kEdge = MarkingType::roadedge;

/// Adds what the vehicle sees of a line.
void add(const Drawn& line, const Road& road, double vehicle_m, DetectionFrame& frame) {
  Detection detection{.type = line.type, .style = line.style, .confidence = 0.9};
  for (double ahead_m = -5.0; ahead_m <= 30.0; ahead_m += 1.0)
    if (vehicle_m + ahead_m <= line.to_m)
      detection.points.push_back(road.pose(vehicle_m).inverse() * road.at(line, vehicle_m + ahead_m));
  if (detection.points.size() > 1) frame.detections.push_back(std::move(detection));
}

/// The maps of 6 s at 8 m/s. An island is a closed road edge in the map frame.
std::vector<LocalMap> maps_of(const std::vector<Drawn>& lines, const MapperConfig& config = {},
                              const Polyline& island = {}, const Road& road = {}) {
  Mapper mapper(config);
  std::vector<LocalMap> maps;
  for (std::int64_t i = 1; i <= 60; ++i) {
    const double vehicle_m = 0.8 * static_cast<double>(i);
    const Eigen::Isometry3d T_map_body = road.pose(vehicle_m);
    DetectionFrame frame{.stamp_ns = i * 100'000'000, .sequence = static_cast<std::uint64_t>(i)};
    for (const Drawn& line : lines) add(line, road, vehicle_m, frame);
    if (!island.empty()) {
      frame.detections.push_back({.type = kEdge, .confidence = 0.9});
      for (const Point& point : island)
        frame.detections.back().points.push_back(T_map_body.inverse() * point);
    }
    maps.push_back(mapper.update(frame, T_map_body));
  }
  return maps;
}

LocalMap driven(const std::vector<Drawn>& lines, const MapperConfig& config = {}) {
  return maps_of(lines, config).back();
}

/// The lane at a lateral place beside the vehicle. Null: there is none.
const Lane* lane_at(const LocalMap& map, double left_m) {
  const Point place = map.T_map_body * Point(0.0, left_m, 0.0);
  for (const Lane& lane : map.lanes) {
    const Projection left = MeasuredPolyline(lane.left).project(place),
                     right = MeasuredPolyline(lane.right).project(place);
    if (left.inside && right.inside && left.lateral_m * right.lateral_m < 0.0) return &lane;
  }
  return nullptr;
}

TEST(RoadKinds, AStreetFromKerbToKerbHasOneLaneOrTwoAtAnyWidth) {
  for (double width_m = 2.4; width_m <= 16.0; width_m += 0.4) {
    SCOPED_TRACE(width_m);
    const bool is_wide = width_m > 6.2;
    const double from_right_m = (is_wide ? 0.25 : 0.5) * width_m;
    const LocalMap map = driven({{kEdge, width_m - from_right_m}, {kEdge, -from_right_m}});
    EXPECT_THAT(map.lanes, SizeIs(is_wide ? 2 : 1));
    ASSERT_NE(lane_at(map, 0.0), nullptr) << "the vehicle's";
    EXPECT_NEAR(lane_at(map, 0.0)->width_m, is_wide ? 0.5 * width_m : width_m, 0.1);
  }
}

TEST(RoadKinds, AStreetHasTwoLanesWhereverTheVehicleDrives) {
  for (const double width_m : {6.4, 9.0, 12.0, 15.6})
    for (double share = 0.15; share < 0.86; share += 0.1) {
      SCOPED_TRACE(testing::Message() << width_m << " m, " << share);
      const double from_right_m = share * width_m;
      EXPECT_THAT(driven({{kEdge, width_m - from_right_m}, {kEdge, -from_right_m}}).lanes, SizeIs(2));
    }
}

TEST(RoadKinds, ANarrowRoadBetweenKerbsHasTwoLanesBesideASolidLine) {
  for (double width_m = 2.8; width_m < 3.5; width_m += 0.1) {
    SCOPED_TRACE(width_m);
    const LocalMap map = driven({{kEdge, 1.5 * width_m}, {.left_m = 0.5 * width_m}, {kEdge, -0.5 * width_m}});
    EXPECT_THAT(map.lanes, SizeIs(2));
    EXPECT_NE(lane_at(map, width_m), nullptr) << "the oncoming one";
  }
}

TEST(RoadKinds, WhereTheLineInTheMiddleEndsBothLanesGoOn) {
  for (const double width_m : {6.4, 6.6, 7.0, 7.5})
    for (const MarkingType right : {MarkingType::laneline, kEdge}) {
      SCOPED_TRACE(testing::Message() << width_m << " m, " << (right == kEdge ? "a kerb" : "a line"));
      const double half_m = 0.25 * width_m;
      const std::vector<LocalMap> maps =
          maps_of({{.left_m = 3.0 * half_m},
                   {.left_m = half_m, .style = MarkingStyle::dashed, .to_m = 30.0},
                   {.type = right, .left_m = -half_m}});
      const auto has_both = [&](const LocalMap& map) {
        const Lane *own = lane_at(map, 0.0), *other = lane_at(map, 2.0 * half_m);
        return own != nullptr && std::abs(own->width_m - 2.0 * half_m) < 0.3 && other != nullptr;
      };
      EXPECT_LE(std::ranges::count_if(maps.begin() + 20, maps.end(), std::not_fn(has_both)), 3);
    }
}

/// A ramp, beside a road with lines. Where one lane becomes two, some maps have neither beside the vehicle.
TEST(RoadKinds, AStreetThatNarrowsOrWidensHasALaneWhereTheVehicleDrives) {
  for (const double width_m : {4.4, 5.2, 6.0, 6.8, 7.6})
    for (const double per_metre : {-0.05, -0.03, 0.03, 0.05}) {
      SCOPED_TRACE(testing::Message() << width_m << " m halfway, " << per_metre << " more per metre");
      const double left_m = 0.5 * (width_m - 24.0 * per_metre);
      const std::vector<LocalMap> maps =
          maps_of({{.type = kEdge, .left_m = left_m, .per_metre = 0.5 * per_metre},
                   {.type = kEdge, .left_m = -left_m, .per_metre = -0.5 * per_metre},
                   {.left_m = -left_m - 3.0},
                   {.left_m = -left_m - 6.5}});
      EXPECT_LE(std::ranges::count_if(maps.begin() + 9, maps.end(),
                                      [](const LocalMap& map) { return lane_at(map, 0.2) == nullptr; }),
                3);
    }
}

/// Lines are painted along its kerbs, on one side or on both.
TEST(RoadKinds, NoLaneLiesOnAMedian) {
  for (const double median_m : {1.0, 2.0, 3.0, 4.0, 6.0})
    for (const double beside_m : {0.3, 0.5, 0.8})
      for (const bool both : {true, false}) {
        SCOPED_TRACE(testing::Message()
                     << median_m << " m, lines " << beside_m << (both ? " beside both" : ""));
        const double from_m = 1.7 + beside_m, to_m = from_m + median_m,
                     lane_m = both ? to_m + beside_m : to_m;
        std::vector<Drawn> road{
            {.left_m = -1.7}, {.left_m = 1.7}, {kEdge, from_m}, {kEdge, to_m}, {.left_m = lane_m + 3.5}};
        if (both) road.push_back({.left_m = lane_m});
        const LocalMap map = driven(road);
        EXPECT_EQ(lane_at(map, 0.5 * (from_m + to_m)), nullptr);
        EXPECT_NE(lane_at(map, 0.0), nullptr);
        EXPECT_NE(lane_at(map, lane_m + 1.75), nullptr);
      }
}

/// A bay for buses, 15 m long, as networks draw it: with square corners.
TEST(RoadKinds, AKerbThatStepsAsideForABayStaysABorder) {
  for (const double depth_m : {1.0, 2.0, 2.5}) {
    SCOPED_TRACE(depth_m);
    const std::vector<LocalMap> maps = maps_of({{kEdge, 1.8}}, {},
                                               {{-20, -1.8, 0},
                                                {25, -1.8, 0},
                                                {26, -1.8 - depth_m, 0},
                                                {40, -1.8 - depth_m, 0},
                                                {41, -1.8, 0},
                                                {90, -1.8, 0}});
    for (std::size_t i = 5; i < maps.size(); ++i)
      EXPECT_NE(lane_at(maps[i], 0.0), nullptr) << "frame " << i + 1;
  }
}

TEST(RoadKinds, ALaneThatWidensAtABayGoesOn) {
  for (const double over_m : {4.0, 6.0, 8.0, 10.0}) {
    SCOPED_TRACE(over_m);
    const Polyline kerb{
        {-10.0, -1.7, 0.0}, {30.0, -1.7, 0.0}, {30.0 + over_m, -3.7, 0.0}, {110.0, -3.7, 0.0}};
    const std::vector<LocalMap> maps = maps_of({{.left_m = 1.7}}, {}, kerb);
    const Lane* own = lane_at(maps[32], 0.0);  // 4 m before the bay
    ASSERT_NE(own, nullptr);
    EXPECT_GT(own->centerline.back().x(), 45.0);
  }
}

TEST(RoadKinds, TwoLanesBeyondASolidLineMakeItsKerbLaneNoShoulder) {
  for (const double beyond_m : {7.5, 8.5, 9.0}) {
    SCOPED_TRACE(beyond_m);
    const LocalMap map = driven({{kEdge, 7.8}, {.left_m = 1.6}, {kEdge, 1.6 - beyond_m}});
    const Lane* beside = lane_at(map, 4.7);
    ASSERT_NE(beside, nullptr);
    EXPECT_NEAR(beside->width_m, 6.2, 0.2);
  }
}

TEST(RoadKinds, OneLaneLiesBetweenPaintedLinesUpToSixMetresApart) {
  for (const MarkingStyle style : {MarkingStyle::solid, MarkingStyle::dashed})
    for (double width_m = 2.6; width_m <= 6.05; width_m += 0.2) {
      SCOPED_TRACE(width_m);
      const LocalMap map =
          driven({{.left_m = 0.5 * width_m, .style = style}, {.left_m = -0.5 * width_m, .style = style}});
      ASSERT_NE(lane_at(map, 0.0), nullptr);
      EXPECT_NEAR(lane_at(map, 0.0)->width_m, width_m, 0.1);
    }
}

/// The lanes beside the vehicle, from right to left: where each begins and ends across the road.
std::vector<std::pair<double, double>> lanes_across(const LocalMap& map) {
  std::vector<std::pair<double, double>> across;
  for (const Lane& lane : map.lanes) {
    const Projection left = MeasuredPolyline(lane.left).project(map.T_map_body.translation()),
                     right = MeasuredPolyline(lane.right).project(map.T_map_body.translation());
    if (left.inside && right.inside) across.push_back(std::minmax({left.foot.y(), right.foot.y()}));
  }
  std::ranges::sort(across);
  return across;
}

TEST(RoadKinds, GuessesBesideDashedLinesDoNotOverlap) {
  for (double width_m = 5.0; width_m <= 9.0; width_m += 0.2) {
    SCOPED_TRACE(width_m);
    const auto across = lanes_across(driven({{.left_m = 0.5 * width_m, .style = MarkingStyle::dashed},
                                             {.left_m = -0.5 * width_m, .style = MarkingStyle::dashed}}));
    ASSERT_GE(across.size(), 3U);
    for (std::size_t i = 1; i < across.size(); ++i) EXPECT_LT(across[i - 1].second - across[i].first, 0.2);
  }
}

TEST(RoadKinds, ALaneLiesBesideASingleKerb) {
  for (const double side : {-1.0, 1.0})
    for (double aside_m = 1.0; aside_m <= 2.6; aside_m += 0.2) {
      SCOPED_TRACE(side * aside_m);
      const LocalMap map = driven({{kEdge, side * aside_m}});
      EXPECT_THAT(map.lanes, SizeIs(1));
      EXPECT_NE(lane_at(map, 0.0), nullptr);
    }
}

/// A truck with its antenna on the roof, and a car on a bridge above the lines.
TEST(RoadKinds, TheBodysOriginMayLieFiveMetresAboveTheRoad) {
  const auto map_from = [](double above_m) {
    const Drawn left{.left_m = 1.75, .up_m = -above_m}, right{.left_m = -1.75, .up_m = -above_m};
    return driven({left, right});
  };
  const LocalMap ground = map_from(0.0);
  ASSERT_THAT(ground.lanes, SizeIs(1));
  ASSERT_TRUE(ground.way.has_value());
  for (const double above_m : {1.0, 2.5, 4.5}) {
    SCOPED_TRACE(above_m);
    const LocalMap map = map_from(above_m);
    ASSERT_THAT(map.lanes, SizeIs(1));
    EXPECT_EQ(map.lanes[0].direction, ground.lanes[0].direction);
    EXPECT_EQ(map.way.has_value(), ground.way.has_value());
    EXPECT_EQ(map.lanes[0].evidence, ground.lanes[0].evidence);
  }
  EXPECT_FALSE(map_from(7.0).way.has_value());
}

/// A single kerb, and a line across from a kerb.
TEST(RoadKinds, TheVehicleHasALaneRoundBends) {
  for (const double radius_m : {100.0, 60.0, 40.0, 25.0, -25.0, -60.0})
    for (const std::vector<Drawn>& lines :
         {std::vector<Drawn>{{kEdge, -1.8}}, {{.left_m = -1.7}, {kEdge, 5.0}}}) {
      SCOPED_TRACE(testing::Message() << radius_m << " m, " << lines.size() << " lines");
      EXPECT_NE(lane_at(maps_of(lines, {}, {}, {.radius_m = radius_m}).back(), 0.0), nullptr);
    }
}

/// Cross-sections that a bend pushes together are left out. Those that it then lacks are put back.
TEST(RoadKinds, ALaneRoundAHairpinFollowsItsLines) {
  for (const double radius_m : {10.0, 14.0, -10.0, -14.0}) {
    const Road road{.radius_m = radius_m};
    const std::vector<LocalMap> maps =
        maps_of({{.left_m = 1.75}, {.left_m = -1.75}, {kEdge, 5.25}, {kEdge, -5.25}}, {}, {}, road);
    for (std::size_t i = 20; i < maps.size(); i += 5)
      for (const Lane& lane : maps[i].lanes) {
        SCOPED_TRACE(testing::Message() << radius_m << " m, frame " << i + 1 << ", lane " << lane.id);
        for (const Polyline& side : {lane.left, lane.right})
          for (std::size_t k = 1; k < side.size(); ++k) {
            const Point middle = 0.5 * (side[k - 1] + side[k]);
            const double from_middle_m =
                std::abs((middle - Point(0.0, radius_m, 0.0)).norm() - std::abs(radius_m));
            EXPECT_LT(std::min(std::abs(from_middle_m - 1.75), std::abs(from_middle_m - 5.25)), 0.25);
          }
      }
  }
}

/// Islands, bays and bollards of both hands, as data sets give their kerbs.
TEST(RoadKinds, AClosedKerbBesideTheLaneIsAnEdge) {
  const std::vector<Polyline> outlines{
      {{0, 0, 0}, {14, 0, 0}, {14, 2, 0}, {0, 2, 0}, {0, 0, 0}},                              // narrow
      {{0, 0, 0}, {25, 0, 0}, {25, 1.5, 0}, {0, 1.5, 0}, {0, 0, 0}},                          // long
      {{0, 0, 0}, {9, 0, 0}, {9, 4, 0}, {0, 4, 0}, {0, 0, 0}},                                // wide
      {{0, 0, 0}, {16, 0, 0}, {8, 4, 0}, {0, 0, 0}},                                          // triangle
      {{0, 0, 0}, {3, -1, 0}, {12, -1, 0}, {15, 0, 0}, {12, 1, 0}, {3, 1, 0}, {0, 0, 0}},     // with tips
      {{0, 0, 0}, {2, 2.5, 0}, {12, 2.5, 0}, {14, 0, 0}, {14, 4, 0}, {0, 4, 0}, {0, 0, 0}}};  // bay
  for (std::size_t kind = 0; kind < outlines.size(); ++kind)
    for (const double side : {-1.0, 1.0}) {
      SCOPED_TRACE(testing::Message() << "outline " << kind << ", side " << side);
      Polyline island;
      for (const Point& point : outlines[kind])
        island.emplace_back(25.0 + point.x(), side * (4.0 + point.y()), 0.0);
      const std::vector<LocalMap> maps =
          maps_of({{MarkingType::laneline, 1.75}, {MarkingType::laneline, -1.75}}, {}, island);
      for (std::size_t i = 4; i < 20; ++i) {
        const auto is_kerb = [](const Marking& boundary) { return boundary.type == kEdge; };
        EXPECT_TRUE(std::ranges::any_of(maps[i].boundaries, is_kerb)) << "frame " << i + 1;
      }
    }
}

/// The lane would lead from the vehicle's line over the near kerb to the far one.
TEST(RoadKinds, NoLaneLeadsOverAnIsland) {
  for (const double side : {-1.0, 1.0})
    for (const double begin_m : {0.0, 7.0})
      for (const double width_m : {1.5, 2.0, 3.0}) {
        SCOPED_TRACE(testing::Message() << "side " << side << ", " << width_m << " m, from " << begin_m);
        Polyline island{{0, 0, 0}, {14, 0, 0}, {14, width_m, 0}, {0, width_m, 0}, {0, 0, 0}};
        for (Point& point : island) point = {30.0 + point.x(), side * (2.75 + point.y()), 0.0};
        island.front().x() = island.back().x() = 30.0 + begin_m;
        if (begin_m > 0.0) island.insert(island.end() - 1, {30.0, side * 2.75, 0.0});
        const std::vector<LocalMap> maps =
            maps_of({{MarkingType::laneline, 1.75}, {MarkingType::laneline, -1.75}}, {}, island);
        for (std::size_t i = 20; i < maps.size(); ++i) EXPECT_THAT(maps[i].lanes, SizeIs(1)) << i;
      }
}

/// One edge turns back at the end of the street.
TEST(RoadKinds, ADeadEndHasALane) {
  for (const double half_m : {1.5, 2.0, 2.5}) {
    SCOPED_TRACE(half_m);
    const Polyline edge{{-10, half_m, 0}, {60, half_m, 0}, {60, -half_m, 0}, {-10, -half_m, 0}};
    const LocalMap map = maps_of({}, {}, edge).back();
    EXPECT_THAT(map.lanes, SizeIs(1));
    EXPECT_NE(lane_at(map, 0.0), nullptr);
  }
}

/// Lines 5 m apart, as on a fifth of the lanes of a public map.
TEST(RoadKinds, ALaneBetweenSolidLinesIsUpToFiveMetresWide) {
  for (double width_m = 2.4; width_m <= 5.3; width_m += 0.2) {
    SCOPED_TRACE(width_m);
    const LocalMap map =
        driven({{MarkingType::laneline, 0.5 * width_m}, {MarkingType::laneline, -0.5 * width_m}});
    EXPECT_THAT(map.lanes, SizeIs(1));
    EXPECT_NE(lane_at(map, 0.0), nullptr);
  }
}

/// One lane up to some width, two above, and one under the vehicle in between.
TEST(RoadKinds, TheVehicleHasALaneBesideALineAtAnyWidth) {
  for (const MarkingType left : {MarkingType::laneline, kEdge})
    for (const MarkingType right : {MarkingType::laneline, kEdge})
      for (double width_m = 2.4; width_m < 8.0; width_m += 0.1)
        for (const double from_right : {0.28, 0.72}) {
          if (left == kEdge && right == kEdge) continue;
          SCOPED_TRACE(testing::Message() << (left == kEdge ? "edge, " : "line, ") << width_m << " m, "
                                          << (right == kEdge ? "edge, " : "line, ") << from_right);
          const LocalMap map = driven({{left, (1.0 - from_right) * width_m}, {right, -from_right * width_m}});
          EXPECT_NE(lane_at(map, 0.0), nullptr);
          EXPECT_LE(map.lanes.size(), 2U);
        }
}

/// The vehicle's own lines are unseen. On its far side there are a lane and a strip for parking.
void expect_not_told_to_run_along(const std::vector<Drawn>& lines, double lane_y_m, DrivingSide keeps) {
  MapperConfig config;
  config.direction.driving_side = keeps;
  const LocalMap map = driven(lines, config);
  const Lane* lane = lane_at(map, lane_y_m);
  ASSERT_NE(lane, nullptr);
  const bool runs_ahead = lane->centerline.back().x() > lane->centerline.front().x();
  EXPECT_TRUE(lane->direction == Lane::Direction::unknown ||
              (lane->direction == Lane::Direction::along_centerline && !runs_ahead));
}

TEST(RoadKinds, ALaneBeyondASolidLineIsNotToldToRunAlong) {
  for (const DrivingSide keeps : {DrivingSide::right, DrivingSide::left})
    for (const double line_m : {1.75, 3.6, 4.9, 6.5})
      for (const double width_m : {2.8, 3.3, 3.8})
        for (const bool own_edge_is_seen : {true, false}) {
          SCOPED_TRACE(testing::Message() << "line " << line_m << ", lane " << width_m << ", own edge "
                                          << (own_edge_is_seen ? "seen" : "unseen"));
          const double far = keeps == DrivingSide::right ? 1.0 : -1.0;
          std::vector<Drawn> lines{{kEdge, far * (line_m + width_m + 3.4)},
                                   {MarkingType::laneline, far * (line_m + width_m)},
                                   {MarkingType::laneline, far * line_m}};
          if (own_edge_is_seen) lines.push_back({kEdge, far * -5.1});
          expect_not_told_to_run_along(lines, far * (line_m + 0.5 * width_m), keeps);
        }
}

}  // namespace
}  // namespace laneloom
