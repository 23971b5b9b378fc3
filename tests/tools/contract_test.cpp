#include "contract/contract.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace laneloom {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Polyline line_at(double y, double from_x = 0.0, double to_x = 20.0) {
  return {{from_x, y, 0.0}, {(from_x + to_x) / 2, y, 0.0}, {to_x, y, 0.0}};
}

Marking marking(ElementId id, MarkingType type, const Polyline& points) {
  Marking m;
  m.id = id;
  m.type = type;
  m.points = points;
  m.styles = {{{0.0, 10.0}, MarkingStyle::dashed}, {{10.0, 20.0}, MarkingStyle::solid}};
  m.lateral_stddev_m.assign(points.size(), 0.1);
  return m;
}

Lane lane(ElementId id, double right_y, ElementId left_boundary, ElementId right_boundary) {
  Lane l;
  l.id = id;
  l.left_borders = {{left_boundary, {0.0, 20.0}, {0.0, 20.0}}};
  l.right_borders = {{right_boundary, {0.0, 20.0}, {0.0, 20.0}}};
  l.left = line_at(right_y + 3.0);
  l.right = line_at(right_y);
  l.centerline = line_at(right_y + 1.5);
  l.width_m = 3.0;
  l.use = Lane::Use::lane;
  l.evidence = Evidence::markings | Evidence::edges;
  l.direction = Lane::Direction::along_centerline;
  l.direction_probability = 0.9;
  l.direction_evidence = Evidence::edges;
  return l;
}

/// Straight on in lane 10.
Way way() {
  Way way{.stations = {}, .lanes = {{.id = 10}}, .known_m = 10.5, .confirmed_m = 4.0};
  for (int x = 5; x <= 15; ++x)
    way.stations.push_back({.point = {static_cast<double>(x), 1.5, 0.0}, .lane = 10});
  return way;
}

/// Two lanes side by side (10 right of 11) between the boundaries 1, 2, 3, and stopline 4. The vehicle is in
/// lane 10.
PublishedMap good_map() {
  PublishedMap map;
  map.sequence = 7;
  map.session_id = 1;
  map.age_s = 0.1;
  map.state = MapState::ok;
  map.map.stamp_ns = 1'000'000'000;
  map.map.boundaries = {marking(1, MarkingType::roadedge, line_at(0.0)),
                        marking(2, MarkingType::laneline, line_at(3.0)),
                        marking(3, MarkingType::roadedge, line_at(6.0))};
  map.map.markings = map.map.boundaries;
  map.map.lanes = {lane(10, 0.0, 2, 1), lane(11, 3.0, 3, 2)};
  map.map.lanes[0].left_neighbours = {{.lane = 11, .range = {0.0, 20.0}}};
  map.map.lanes[1].right_neighbours = {{.lane = 10, .range = {0.0, 20.0}}};
  Stopline stopline;
  stopline.marking = marking(4, MarkingType::stopline, {{20, 0, 0}, {20, 6, 0}});
  stopline.marking.styles.clear();
  stopline.marking.lateral_stddev_m.clear();
  stopline.lanes = {10, 11};
  map.map.stoplines = {stopline};
  Linkage linkage;
  linkage.from = 10;
  linkage.to = 11;
  linkage.path = {{20, 1.5, 0}, {0, 4.5, 0}};
  linkage.evidence = Evidence::ego_path;
  map.map.linkages = {linkage};
  map.map.T_map_body.translation() = Point(5.0, 1.0, 0.0);
  map.map.way = way();
  map.map.driven_paths = {{.id = 5, .points = line_at(20.0), .lateral_stddev_m = 0.6, .probability = 0.5}};
  return map;
}

struct Fault {
  const char* label;
  contract::ContractRule rule;
  std::function<void(PublishedMap&)> make;
};

std::ostream& operator<<(std::ostream& out, const Fault& fault) { return out << fault.label; }

class ContractFault : public testing::TestWithParam<Fault> {};

TEST(Contract, HoldsForAGoodMap) {
  const PublishedMap map = good_map();
  PublishedMap previous = map;
  previous.sequence = 6;
  previous.age_s = 0.05;
  for (const contract::Violation& v : contract::check_contract(map, &previous))
    ADD_FAILURE() << name(v.rule) << ": " << v.detail;
}

TEST(Contract, HoldsForAVehicleAtTheSideOfAWideLane) {
  PublishedMap map = good_map();
  map.map.T_map_body.translation().y() += 3.2;
  EXPECT_FALSE(contract::check_contract(map, nullptr).empty());
  map.map.way->stations.front().left_m = 2.0;
  EXPECT_TRUE(contract::check_contract(map, nullptr).empty());
}

TEST(Contract, HoldsForABorderThatChangesOrIsUnseen) {
  PublishedMap map = good_map();
  map.map.boundaries.push_back(marking(7, MarkingType::roadedge, line_at(0.0)));
  Lane& lane = map.map.lanes[0];
  lane.right_borders = {
      {1, {0.0, 8.0}, {0.0, 8.0}}, {kNoElement, {8.0, 12.0}, {}}, {7, {12.0, 20.0}, {1.0, 9.0}}};
  EXPECT_TRUE(contract::check_contract(map, nullptr).empty());
}

TEST(Contract, HoldsForLanesWhoseOverlapIsWithinTheirDeviations) {
  PublishedMap map = good_map();
  Lane& upper = map.map.lanes[1];
  for (Point& point : upper.right) point.y() -= 0.4;  // of 3 deviations of two lines of 0.1 m each
  for (const contract::Violation& v : contract::check_lanes_apart(map.map)) ADD_FAILURE() << v.detail;
}

TEST(Contract, LanesThatOverlapByMoreAreFoundWhateverTheirOrder) {
  PublishedMap map = good_map();
  for (Point& point : map.map.lanes[1].right) point.y() -= 0.7;
  const auto rule = testing::Field(&contract::Violation::rule, contract::ContractRule::lanes_apart);
  EXPECT_THAT(contract::check_lanes_apart(map.map), testing::Contains(rule));
  std::swap(map.map.lanes[0], map.map.lanes[1]);
  EXPECT_THAT(contract::check_lanes_apart(map.map), testing::Contains(rule));
  map.map.lanes[0].use = Lane::Use::shoulder;
  EXPECT_THAT(contract::check_lanes_apart(map.map), testing::IsEmpty());
}

TEST(Contract, LanesMayOverlapAtTheirEnds) {
  const auto behind = [](double along_m) {
    PublishedMap map = good_map();
    Lane& upper = map.map.lanes[1];
    for (Polyline* line : {&upper.left, &upper.right, &upper.centerline})
      for (Point& point : *line) point += Point(along_m, -1.5, 0.0);
    return contract::check_lanes_apart(map.map);
  };
  EXPECT_THAT(behind(19.0), testing::IsEmpty()) << "each lane is 20 m long";
  EXPECT_THAT(behind(15.0), testing::Not(testing::IsEmpty()));
}

TEST(Contract, LineageOfAMapThatWasMissedIsNotAskedFor) {
  PublishedMap map = good_map();
  PublishedMap previous = map;
  previous.sequence = map.sequence - 2;
  previous.map.lanes[0].id = 12;
  EXPECT_TRUE(contract::check_contract(map, &previous).empty());
}

TEST(Contract, LineageTellsOfLanesThatComeAndGo) {
  PublishedMap map = good_map();
  PublishedMap previous = map;
  previous.sequence = map.sequence - 1;
  previous.map.lanes[0].id = 12;
  EXPECT_EQ(contract::check_contract(map, &previous).size(), 2U);
  using Kind = LineageEvent::Kind;
  map.map.lineage = {{Kind::split_from, LineageEvent::Element::lane, 10, 12},
                     {Kind::merged_into, LineageEvent::Element::lane, 12, 10}};
  EXPECT_TRUE(contract::check_contract(map, &previous).empty());
  map.map.lineage[0].element = LineageEvent::Element::boundary;
  EXPECT_EQ(contract::check_contract(map, &previous).size(), 1U);
}

TEST(Contract, HoldsForAMapBeforeAnythingWasFused) {
  PublishedMap map;
  map.reasons = {StateReason::starting};
  EXPECT_TRUE(contract::check_contract(map, nullptr).empty());
}

TEST(Contract, HoldsForNeighboursOfOppositeDirections) {
  PublishedMap map = good_map();
  Lane& upper = map.map.lanes[1];
  std::swap(upper.left, upper.right);
  std::swap(upper.left_borders, upper.right_borders);
  for (Polyline* line : {&upper.left, &upper.right, &upper.centerline})
    std::reverse(line->begin(), line->end());
  upper.left_borders.front().on_boundary = upper.right_borders.front().on_boundary = {20.0, 0.0};
  std::swap(upper.left_neighbours, upper.right_neighbours);
  map.map.linkages[0].path.back() = upper.centerline.front();
  EXPECT_TRUE(contract::check_contract(map, nullptr).empty());
}

TEST_P(ContractFault, IsFound) {
  PublishedMap map = good_map();
  GetParam().make(map);
  PublishedMap previous = good_map();
  previous.sequence = 6;
  previous.age_s = 0.05;
  const std::vector<contract::Violation> violations = contract::check_contract(map, &previous);
  EXPECT_THAT(violations, testing::Contains(testing::Field(&contract::Violation::rule, GetParam().rule)));
}

Lane& lower(PublishedMap& map) { return map.map.lanes[0]; }
Lane& upper(PublishedMap& map) { return map.map.lanes[1]; }

INSTANTIATE_TEST_SUITE_P(
    EveryRule, ContractFault,
    testing::Values(
        Fault{"point", contract::ContractRule::finite_numbers,
              [](auto& m) { m.map.boundaries[0].points[1].z() = kNan; }},
        Fault{"lane_point", contract::ContractRule::finite_numbers,
              [](auto& m) { lower(m).centerline[1].x() = kNan; }},
        Fault{"pose", contract::ContractRule::finite_numbers,
              [](auto& m) { m.map.T_map_body.translation().x() = kNan; }},
        Fault{"heading", contract::ContractRule::finite_numbers,
              [](auto& m) { m.map.stoplines[0].heading.x() = kNan; }},
        Fault{"empty_line", contract::ContractRule::valid_geometry,
              [](auto& m) { m.map.markings[0].points.clear(); }},
        Fault{"one_point", contract::ContractRule::valid_geometry, [](auto& m) { lower(m).right.resize(1); }},
        Fault{"no_length", contract::ContractRule::valid_geometry,
              [](auto& m) {
                m.map.boundaries[0].points = {{1, 1, 0}, {1, 1, 5}};
              }},
        Fault{"path", contract::ContractRule::valid_geometry,
              [](auto& m) {
                m.map.linkages[0].path = {{1, 1, 0}};
              }},
        Fault{"boundary_twice", contract::ContractRule::unique_ids,
              [](auto& m) { m.map.boundaries[1].id = 1; }},
        Fault{"instance_twice", contract::ContractRule::unique_ids,
              [](auto& m) { m.map.markings[1].id = 1; }},
        Fault{"stopline_is_boundary", contract::ContractRule::unique_ids,
              [](auto& m) { m.map.stoplines[0].marking.id = 3; }},
        Fault{"lane_twice", contract::ContractRule::unique_ids, [](auto& m) { upper(m).id = 10; }},
        Fault{"no_id", contract::ContractRule::unique_ids,
              [](auto& m) { m.map.boundaries[0].id = kNoElement; }},
        Fault{"unknown_boundary", contract::ContractRule::known_ids,
              [](auto& m) { lower(m).left_borders.front().boundary = 99; }},
        Fault{"unknown_neighbour", contract::ContractRule::known_ids,
              [](auto& m) {
                lower(m).left_neighbours = {{.lane = 99, .range = {0.0, 20.0}}};
              }},
        Fault{"own_neighbour", contract::ContractRule::known_ids,
              [](auto& m) {
                lower(m).left_neighbours = {{.lane = 10, .range = {0.0, 20.0}}};
              }},
        Fault{"unknown_stopline_lane", contract::ContractRule::known_ids,
              [](auto& m) { m.map.stoplines[0].lanes = {99}; }},
        Fault{"linkage_from", contract::ContractRule::known_ids,
              [](auto& m) { m.map.linkages[0].from = 99; }},
        Fault{"linkage_to", contract::ContractRule::known_ids, [](auto& m) { m.map.linkages[0].to = 99; }},
        Fault{"linkage_to_itself", contract::ContractRule::known_ids,
              [](auto& m) { m.map.linkages[0].to = 10; }},
        Fault{"swapped_sides", contract::ContractRule::left_is_left,
              [](auto& m) { std::swap(lower(m).left, lower(m).right); }},
        Fault{"crossing_sides", contract::ContractRule::left_is_left,
              [](auto& m) { lower(m).left.back().y() = -1.0; }},
        Fault{"opposite_sides", contract::ContractRule::left_is_left,
              [](auto& m) { std::reverse(lower(m).left.begin(), lower(m).left.end()); }},
        Fault{"centerline_left", contract::ContractRule::centered_line,
              [](auto& m) { lower(m).centerline[1].y() = 3.2; }},
        Fault{"centerline_right", contract::ContractRule::centered_line,
              [](auto& m) { lower(m).centerline[1].y() = -0.2; }},
        Fault{"one_sided_left", contract::ContractRule::neighbours_across_boundary,
              [](auto& m) { upper(m).right_neighbours.clear(); }},
        Fault{"one_sided_right", contract::ContractRule::neighbours_across_boundary,
              [](auto& m) { lower(m).left_neighbours.clear(); }},
        Fault{"wrong_side", contract::ContractRule::neighbours_across_boundary,
              [](auto& m) { std::swap(upper(m).left_neighbours, upper(m).right_neighbours); }},
        Fault{"range_beyond", contract::ContractRule::range_in_boundary,
              [](auto& m) { lower(m).left_borders.front().on_boundary.to_m = 20.2; }},
        Fault{"range_before", contract::ContractRule::range_in_boundary,
              [](auto& m) { lower(m).right_borders.front().on_boundary.from_m = -0.2; }},
        Fault{"range_empty", contract::ContractRule::range_in_boundary,
              [](auto& m) {
                lower(m).right_borders.front().on_boundary = {5.0, 5.0};
              }},
        Fault{"range_nan", contract::ContractRule::range_in_boundary,
              [](auto& m) { lower(m).right_borders.front().on_boundary.to_m = kNan; }},
        Fault{"inferred_beyond", contract::ContractRule::range_in_boundary,
              [](auto& m) {
                lower(m).inferred_ranges = {{10.0, 21.0}};
              }},
        Fault{"border_missing", contract::ContractRule::covering_borders,
              [](auto& m) { lower(m).right_borders.clear(); }},
        Fault{"border_short", contract::ContractRule::covering_borders,
              [](auto& m) { lower(m).right_borders.front().range.to_m = 19.0; }},
        Fault{"border_gap", contract::ContractRule::covering_borders,
              [](auto& m) {
                lower(m).right_borders = {{1, {0.0, 8.0}, {0.0, 8.0}}, {1, {9.0, 20.0}, {9.0, 20.0}}};
              }},
        Fault{"border_overlap", contract::ContractRule::covering_borders,
              [](auto& m) {
                lower(m).right_borders = {{1, {0.0, 12.0}, {0.0, 12.0}}, {1, {9.0, 20.0}, {9.0, 20.0}}};
              }},
        Fault{"border_nan", contract::ContractRule::covering_borders,
              [](auto& m) { lower(m).right_borders.front().range.to_m = kNan; }},
        Fault{"lane_evidence", contract::ContractRule::stated_evidence,
              [](auto& m) { lower(m).evidence = Evidence::none; }},
        Fault{"linkage_evidence", contract::ContractRule::stated_evidence,
              [](auto& m) { m.map.linkages[0].evidence = Evidence::none; }},
        Fault{"direction_evidence", contract::ContractRule::stated_evidence,
              [](auto& m) { lower(m).direction_evidence = Evidence::none; }},
        Fault{"direction_without_probability", contract::ContractRule::stated_evidence,
              [](auto& m) { lower(m).direction_probability = -1.0; }},
        Fault{"evidence_of_no_direction", contract::ContractRule::stated_evidence,
              [](auto& m) { lower(m).direction = Lane::Direction::unknown; }},
        Fault{"direction_probability", contract::ContractRule::valid_values,
              [](auto& m) { lower(m).direction_probability = 1.5; }},
        Fault{"use_probability", contract::ContractRule::valid_values,
              [](auto& m) { lower(m).use_probability = kNan; }},
        Fault{"driven_path_probability", contract::ContractRule::valid_values,
              [](auto& m) { m.map.driven_paths[0].probability = -1.0; }},
        Fault{"driven_path", contract::ContractRule::valid_geometry,
              [](auto& m) { m.map.driven_paths[0].points.resize(1); }},
        Fault{"lane_came", contract::ContractRule::told_lineage, [](auto& m) { lower(m).id = 12; }},
        Fault{"way_of_one_station", contract::ContractRule::sound_way,
              [](auto& m) { m.map.way->stations.resize(1); }},
        Fault{"way_without_step", contract::ContractRule::sound_way, [](auto& m) { m.map.way->step_m = 0.0; }},
        Fault{"way_station_off", contract::ContractRule::sound_way,
              [](auto& m) { m.map.way->stations[3].point.y() += 0.3; }},
        Fault{"way_station_late", contract::ContractRule::sound_way,
              [](auto& m) { m.map.way->stations[3].point.x() += 0.1; }},
        Fault{"way_heading", contract::ContractRule::sound_way,
              [](auto& m) {
                for (WayStation& station : m.map.way->stations) station.heading_rad = 0.2;
              }},
        Fault{"way_curvature", contract::ContractRule::sound_way,
              [](auto& m) {
                for (WayStation& station : m.map.way->stations) station.curvature_per_m = 0.1;
              }},
        Fault{"way_nan", contract::ContractRule::finite_numbers,
              [](auto& m) { m.map.way->stations[3].width_m = kNan; }},
        Fault{"way_elsewhere", contract::ContractRule::sound_way,
              [](auto& m) { m.map.T_map_body.translation().x() = 2.0; }},
        Fault{"way_unknown_lane", contract::ContractRule::known_ids,
              [](auto& m) { m.map.way->lanes[0].id = 99; }},
        Fault{"way_lane_not_listed", contract::ContractRule::sound_way,
              [](auto& m) { m.map.way->stations[3].lane = 11; }},
        Fault{"way_known", contract::ContractRule::sound_way, [](auto& m) { m.map.way->known_m = 9.0; }},
        Fault{"way_confirmed", contract::ContractRule::sound_way,
              [](auto& m) { m.map.way->confirmed_m = 11.0; }},
        Fault{"style_gap", contract::ContractRule::range_in_boundary,
              [](auto& m) { m.map.boundaries[0].styles[0].range.to_m = 9.0; }},
        Fault{"style_short", contract::ContractRule::range_in_boundary,
              [](auto& m) { m.map.boundaries[0].styles.pop_back(); }},
        Fault{"probability", contract::ContractRule::valid_values,
              [](auto& m) { m.map.boundaries[0].existence_probability = 1.5; }},
        Fault{"lane_probability", contract::ContractRule::valid_values,
              [](auto& m) { lower(m).existence_probability = -0.5; }},
        Fault{"deviation_count", contract::ContractRule::valid_values,
              [](auto& m) { m.map.boundaries[0].lateral_stddev_m.pop_back(); }},
        Fault{"deviation_sign", contract::ContractRule::valid_values,
              [](auto& m) { m.map.boundaries[0].lateral_stddev_m[0] = -0.1; }},
        Fault{"linkage_probability", contract::ContractRule::valid_values,
              [](auto& m) { m.map.linkages[0].probability = kNan; }},
        Fault{"width", contract::ContractRule::valid_values, [](auto& m) { lower(m).width_m = 0.0; }},
        Fault{"stopline_boundary", contract::ContractRule::valid_values,
              [](auto& m) { m.map.boundaries[0].type = MarkingType::stopline; }},
        Fault{"sequence_repeats", contract::ContractRule::ascending_sequence,
              [](auto& m) { m.sequence = 6; }},
        Fault{"sequence_reverses", contract::ContractRule::ascending_sequence,
              [](auto& m) { m.sequence = 5; }},
        Fault{"age_negative", contract::ContractRule::possible_age, [](auto& m) { m.age_s = -0.5; }},
        Fault{"linkage_over_a_gap", contract::ContractRule::joined_lanes_meet,
              [](auto& m) { m.map.linkages[0].path.clear(); }},
        Fault{"path_that_begins_late", contract::ContractRule::joined_lanes_meet,
              [](auto& m) { m.map.linkages[0].path.front().x() += 0.1; }},
        Fault{"path_that_ends_early", contract::ContractRule::joined_lanes_meet,
              [](auto& m) { m.map.linkages[0].path.back().x() += 0.1; }},
        Fault{"turned_lane", contract::ContractRule::kept_orientation,
              [](auto& m) { std::reverse(lower(m).centerline.begin(), lower(m).centerline.end()); }},
        Fault{"age_none", contract::ContractRule::possible_age, [](auto& m) { m.age_s = -1.0; }},
        Fault{"age_without_stamp", contract::ContractRule::possible_age, [](auto& m) { m.map.stamp_ns = 0; }},
        Fault{"age_falls", contract::ContractRule::possible_age, [](auto& m) { m.age_s = 0.01; }},
        Fault{"reason_missing", contract::ContractRule::stated_reasons,
              [](auto& m) { m.state = MapState::degraded; }},
        Fault{"reason_too_many", contract::ContractRule::stated_reasons,
              [](auto& m) { m.reasons = {StateReason::no_poses}; }}),
    [](const testing::TestParamInfo<Fault>& fault) { return std::string(fault.param.label); });

TEST(Contract, AFrameOfASlowerSourceRenewsTheAgeAndNotTheStamp) {
  PublishedMap map = good_map();
  PublishedMap previous = map;
  previous.sequence = map.sequence - 1;
  map.age_s = previous.age_s / 2.0;
  EXPECT_FALSE(contract::check_contract(map, &previous).empty());
  map.fused_frames = {{.source = "slower", .stamp_ns = map.map.stamp_ns - 1}};
  EXPECT_TRUE(contract::check_contract(map, &previous).empty());
  map.fused_frames.clear();
  --previous.sequence;
  EXPECT_TRUE(contract::check_contract(map, &previous).empty()) << "the map between them may have it";
}

TEST(Contract, ANewSessionMayBeginAnew) {
  PublishedMap map = good_map();
  const PublishedMap previous = map;
  map.session_id = 2;
  map.sequence = 0;
  map.age_s = 0.01;
  EXPECT_TRUE(contract::check_contract(map, &previous).empty());
}

TEST(MissedMaps, CountsTheGapWithinASession) {
  PublishedMap map = good_map();
  PublishedMap previous = map;
  EXPECT_EQ(contract::missed_maps(map, nullptr), 0u);
  EXPECT_EQ(contract::missed_maps(map, &previous), 0u);
  previous.sequence = 6;
  EXPECT_EQ(contract::missed_maps(map, &previous), 0u);
  previous.sequence = 3;
  EXPECT_EQ(contract::missed_maps(map, &previous), 3u);
  map.session_id = 2;
  EXPECT_EQ(contract::missed_maps(map, &previous), 0u);
}

}  // namespace
}  // namespace laneloom
