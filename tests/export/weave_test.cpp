#include "export/weave.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "laneloom/polyline.hpp"

namespace laneloom::exports {
namespace {

Marking line(ElementId id, MarkingType type, Polyline points) {
  return {.id = id, .type = type, .points = std::move(points)};
}

/// The points (x, y(x)) from one x to another, half a metre apart.
template <class Course>
Polyline along_x(double from_x, double to_x, Course&& y) {
  Polyline points;
  for (double x = from_x; x <= to_x; x += 0.5) points.emplace_back(x, y(x), 0.0);
  return points;
}

/// A drive along the x axis, from 0 to 60 m, at y = `beside_m`.
SurveyedRoad drive(double beside_m, std::vector<Marking> markings) {
  SurveyedRoad result{.markings = std::move(markings), .poses = {}};
  for (double x = 0.0; x <= 60.0; x += 2.0) result.poses.emplace_back(Eigen::Translation3d(x, beside_m, 0.0));
  return result;
}

/// Whether a lane's centerline passes within half a metre of a place.
bool passes(const Lane& lane, const Point& place) {
  const Projection foot = MeasuredPolyline(lane.centerline).project(place);
  return foot.inside && foot.distance_m < 0.5;
}

TEST(Weave, ALaneThatGivesWayIsLinkedWithTheOneThatOpens) {
  const auto turning_aside = [](double y) {
    return [y](double x) { return y - 3.0 * std::clamp((x - 30.0) / 15.0, 0.0, 1.0); };
  };
  const LocalMap map =
      weave(drive(-1.75, {line(1, MarkingType::laneline, along_x(30.0, 60.0, [](double) { return 0.1; })),
                          line(2, MarkingType::laneline, along_x(0.0, 60.0, turning_aside(0.0))),
                          line(3, MarkingType::laneline, along_x(0.0, 60.0, turning_aside(-3.5)))}),
            {});
  const auto lane_at = [&](const Point& place) {
    const auto found = std::ranges::find_if(map.lanes, [&](const Lane& lane) { return passes(lane, place); });
    return found == map.lanes.end() ? kNoElement : found->id;
  };
  const ElementId stem = lane_at({10.0, -1.75, 0.0}), opened = lane_at({55.0, -1.45, 0.0});
  ASSERT_NE(stem, kNoElement);
  ASSERT_NE(opened, kNoElement);
  EXPECT_TRUE(std::ranges::any_of(
      map.linkages, [&](const Linkage& linkage) { return linkage.from == stem && linkage.to == opened; }));
}

TEST(Weave, AnEdgeIsContinuedWhereItWasNotSeen) {
  const auto beside = [](double y) { return [y](double) { return y; }; };
  const LocalMap map =
      weave(drive(-1.75, {line(1, MarkingType::roadedge, along_x(0.0, 60.0, beside(3.5))),
                          line(2, MarkingType::roadedge, along_x(0.0, 22.0, beside(-3.5))),
                          line(3, MarkingType::roadedge, along_x(38.0, 60.0, beside(-3.5)))}),
            {});
  for (const double x : {10.0, 26.0, 30.0, 34.0, 50.0}) {
    SCOPED_TRACE(x);
    EXPECT_TRUE(std::ranges::any_of(map.lanes, [&](const Lane& lane) {
      return passes(lane, {x, -1.75, 0.0});
    }));
  }
}

TEST(Weave, TheOwnDriveCountsOnlyIfItIsEvidence) {
  const auto beside = [](double y) { return [y](double) { return y; }; };
  const SurveyedRoad surveyed =
      drive(-1.75, {line(1, MarkingType::laneline, along_x(0.0, 60.0, beside(0.0))),
                    line(2, MarkingType::laneline, along_x(0.0, 60.0, beside(-3.5)))});
  for (const bool counts : {true, false}) {
    MapperConfig config;
    config.evidence.ego_path = counts;
    const LocalMap map = weave(surveyed, config);
    ASSERT_FALSE(map.lanes.empty());
    EXPECT_EQ(std::ranges::any_of(map.lanes,
                                  [](const Lane& lane) {
                                    return overlap(lane.evidence | lane.direction_evidence,
                                                   Evidence::ego_path);
                                  }),
              counts);
  }
}

TEST(Weave, ShouldersRunAsTheLanesBesideThem) {
  const auto line_at = [](ElementId id, MarkingType type, double y, MarkingStyle style) {
    Marking marking = line(id, type, along_x(0.0, 60.0, [y](double) { return y; }));
    marking.styles = {{{0.0, 60.0}, style}};
    return marking;
  };
  MapperConfig config;
  config.lane.publish_side_strips = true;
  SurveyedRoad there_and_back =
      drive(-1.75, {line_at(1, MarkingType::roadedge, 5.5, MarkingStyle::unknown),
                    line_at(2, MarkingType::laneline, 3.5, MarkingStyle::solid),
                    line_at(3, MarkingType::laneline, 0.0, MarkingStyle::dashed),
                    line_at(4, MarkingType::laneline, -3.5, MarkingStyle::solid),
                    line_at(5, MarkingType::roadedge, -5.5, MarkingStyle::unknown)});
  const Eigen::AngleAxisd turned(std::numbers::pi, Eigen::Vector3d::UnitZ());
  for (double x = 60.0; x >= 0.0; x -= 2.0)
    there_and_back.poses.emplace_back(Eigen::Translation3d(x, 1.75, 0.0) * turned);
  const LocalMap map = weave(there_and_back, config);
  EXPECT_EQ(std::ranges::count(map.lanes, Lane::Use::shoulder, &Lane::use), 2);
  for (const double side : {-1.0, 1.0}) {
    SCOPED_TRACE(side);
    const auto shoulder = std::ranges::find_if(map.lanes, [&](const Lane& lane) {
      return lane.use == Lane::Use::shoulder && passes(lane, {30.0, side * 4.5, 0.0});
    });
    ASSERT_NE(shoulder, map.lanes.end());
    EXPECT_EQ(shoulder->direction, Lane::Direction::along_centerline);
    const double ahead_m = shoulder->centerline.back().x() - shoulder->centerline.front().x();
    EXPECT_LT(side * ahead_m, -30.0) << "traffic keeps right";
    EXPECT_EQ(shoulder->left_borders.front().boundary, side < 0.0 ? 4U : 2U);
    EXPECT_TRUE(std::ranges::none_of(map.linkages, [&](const Linkage& linkage) {
      return linkage.from == shoulder->id || linkage.to == shoulder->id;
    }));
  }
}

}  // namespace
}  // namespace laneloom::exports
