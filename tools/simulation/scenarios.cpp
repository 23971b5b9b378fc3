#include "simulation/scenarios.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include "simulation/motorways.hpp"
#include "simulation/road_builder.hpp"
#include "simulation/town.hpp"

namespace laneloom::simulation {
namespace {

Road straight_road(double speed_mps) {
  const Alignment way({}, {straight(300.0)});
  RoadBuilder builder("straight");
  builder.add_street(way, two_way(3, 3, CentreLine::double_solid));
  return std::move(builder).build({way.point(10.0, -1.5 * kLaneWidth_m)}, speed_mps);
}

Road curve(double speed_mps) {
  const Alignment way({}, {straight(80.0), bend(12.0, 90.0), straight(80.0)});
  RoadBuilder builder("curve");
  builder.add_street(way, two_way(1, 1, CentreLine::solid));
  return std::move(builder).build({way.point(10.0, -0.5 * kLaneWidth_m)}, speed_mps);
}

// Two lanes each way, with shoulders.
Road motorway(double speed_mps) {
  const Alignment way({}, {straight(100.0), bend(250.0, 45.0), straight(100.0)});
  Section section = two_way(2, 2, CentreLine::double_solid);
  section.shoulder_m = 2.4;
  RoadBuilder builder("motorway");
  builder.add_street(way, section);
  return std::move(builder).build({way.point(10.0, -1.5 * kLaneWidth_m)}, speed_mps);
}

// A residential street, whose line between the directions ends.
Road street(double speed_mps) {
  const Alignment marked({}, {straight(60.0)});
  const Alignment unmarked(marked.end(), {straight(60.0), bend(30.0, 60.0), straight(120.0)});
  RoadBuilder builder("street");
  builder.add_street(marked, two_way(1, 1, CentreLine::dashed));
  builder.add_street(unmarked, two_way(1, 1, CentreLine::none));
  return std::move(builder).build(
      {marked.point(10.0, -0.5 * kLaneWidth_m), unmarked.point(200.0, -0.5 * kLaneWidth_m)}, speed_mps);
}

// A road over land, where only the line between the directions can be seen.
Road country_road(double speed_mps) {
  const Alignment edged({}, {straight(60.0)});
  const Alignment open(edged.end(), {straight(60.0), bend(60.0, -45.0), straight(120.0)});
  Section section = two_way(1, 1, CentreLine::dashed);
  RoadBuilder builder("country_road");
  builder.add_street(edged, section);
  section.visible_edges = false;
  builder.add_street(open, section);
  return std::move(builder).build(
      {edged.point(10.0, -0.5 * kLaneWidth_m), open.point(210.0, -0.5 * kLaneWidth_m)}, speed_mps);
}

// A lane is added on the right, and further on it leaves as an exit.
Road split(double speed_mps) {
  const double exit_at_m = 200.0;
  const Alignment way({}, {straight(300.0)});
  Section section = two_way(1, 1, CentreLine::solid);
  section.forward.changes = {{.at_m = 80.0, .lanes = 2}, {.at_m = exit_at_m, .lanes = 1, .taper_m = 0.0}};
  const Alignment exit(way.at(exit_at_m).moved(-kLaneWidth_m), {bend(60.0, -40.0), straight(60.0)});
  RoadBuilder builder("split");
  builder.add_street(way, section);
  builder.add_street(exit, {.forward = {}, .gore_begin_m = 15.0});
  return std::move(builder).build(
      {way.point(10.0, -0.5 * kLaneWidth_m), way.point(290.0, -0.5 * kLaneWidth_m)}, speed_mps);
}

// A ramp joins on the right, and further on its lane ends.
Road merge(double speed_mps) {
  const double entry_at_m = 100.0;
  const Alignment way({}, {straight(300.0)});
  Section section = two_way(1, 1, CentreLine::solid);
  section.forward.changes = {{.at_m = entry_at_m, .lanes = 2, .taper_m = 0.0}, {.at_m = 190.0, .lanes = 1}};
  // The ramp is laid out backwards from the place where it joins, to find its start.
  const Alignment back(way.at(entry_at_m).moved(-kLaneWidth_m).turned(180.0),
                       {bend(60.0, 40.0), straight(60.0)});
  const Alignment ramp(back.end().turned(180.0), {straight(60.0), bend(60.0, -40.0)});
  RoadBuilder builder("merge");
  builder.add_street(way, section);
  builder.add_street(ramp, {.forward = {}, .gore_end_m = 15.0});
  return std::move(builder).build(
      {way.point(10.0, -0.5 * kLaneWidth_m), way.point(290.0, -0.5 * kLaneWidth_m)}, speed_mps);
}

// Streets of one lane per direction that lead away from the origin.
struct Crossroads {
  std::vector<Alignment> streets;
  RoadBuilder builder;

  Crossroads(std::string name, const std::vector<double>& headings_deg) : builder(std::move(name)) {
    const Section section = two_way(1, 1, CentreLine::solid);
    std::vector<Mouth> mouths;
    for (const double heading_deg : headings_deg) {
      const Frame begin = Frame{}.turned(heading_deg).moved(0.0, kLaneWidth_m + kCornerRadius_m);
      streets.emplace_back(begin, std::vector{straight(100.0)});
      builder.add_street(streets.back(), section);
      mouths.push_back(mouth_at_start(streets.back(), section));
    }
    builder.add_intersection(mouths);
  }

  // A drive in by one street and out by the other.
  Road drive(std::size_t in, std::size_t out, double speed_mps) && {
    return std::move(builder).build(
        {streets[in].point(90.0, 0.5 * kLaneWidth_m), streets[out].point(90.0, -0.5 * kLaneWidth_m)},
        speed_mps);
  }
};

Road t_intersection(double speed_mps) {
  return Crossroads("t_intersection", {0.0, 180.0, 270.0}).drive(2, 1, speed_mps);
}

Road intersection(double speed_mps) {
  return Crossroads("intersection", {0.0, 90.0, 180.0, 270.0}).drive(2, 1, speed_mps);
}

// A road up and down again with 8 % at the steepest: a crest between two sags.
Road hill(double speed_mps) {
  const Profile elevation({{60.0, 0.0}, {210.0, 8.0}, {360.0, 0.0}});
  const Alignment way({}, {straight(420.0)}, elevation);
  RoadBuilder builder("hill");
  builder.add_street(way, two_way(1, 1, CentreLine::dashed));
  return std::move(builder).build({way.point(10.0, -0.5 * kLaneWidth_m)}, speed_mps);
}

// A road over a bridge 6 m high, round three quarters of a circle, and through under the bridge.
Road overpass(double speed_mps) {
  const double radius_m = 50.0, before_m = 120.0, after_m = 50.0;
  const Profile elevation({{before_m + 60.0, 6.0}, {before_m + 60.0 + 190.0, 0.0}});
  const Alignment way(Frame{}.moved(0.0, -before_m),
                      {straight(before_m + after_m), bend(radius_m, 270.0), straight(170.0)}, elevation);
  RoadBuilder builder("overpass");
  builder.add_street(way, two_way(1, 1, CentreLine::solid));
  return std::move(builder).build({way.point(10.0, -0.5 * kLaneWidth_m)}, speed_mps);
}

Road exit(double speed_mps) { return exit_road(speed_mps); }
Road entry(double speed_mps) { return entry_road(speed_mps); }
Road median(double speed_mps) { return divided_road({}, speed_mps); }

using Maker = Road (*)(double speed_mps);
constexpr std::array<std::pair<const char*, Maker>, 15> kScenarios{{{"straight", straight_road},
                                                                    {"curve", curve},
                                                                    {"street", street},
                                                                    {"country_road", country_road},
                                                                    {"motorway", motorway},
                                                                    {"split", split},
                                                                    {"merge", merge},
                                                                    {"exit", exit},
                                                                    {"entry", entry},
                                                                    {"median", median},
                                                                    {"t_intersection", t_intersection},
                                                                    {"intersection", intersection},
                                                                    {"hill", hill},
                                                                    {"overpass", overpass},
                                                                    {"town", town}}};

}  // namespace

std::vector<std::string> scenario_names() {
  std::vector<std::string> names;
  names.reserve(kScenarios.size());
  for (const auto& [name, maker] : kScenarios) names.emplace_back(name);
  return names;
}

Road make_scenario(const std::string& name, double speed_mps) {
  std::string known;
  for (const auto& [candidate, maker] : kScenarios) {
    if (name == candidate) return maker(speed_mps);
    known += (known.empty() ? "" : ", ") + std::string(candidate);
  }
  throw std::invalid_argument("unknown scenario '" + name + "'; known are " + known);
}

}  // namespace laneloom::simulation
