#include "commands/road_source.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "commands/options.hpp"
#include "commands/warn_of.hpp"
#include "simulation/argoverse2.hpp"
#include "simulation/argoverse2_objects.hpp"
#include "simulation/lanelet2.hpp"
#include "simulation/opendrive.hpp"
#include "simulation/recorded_traffic.hpp"
#include "simulation/scenarios.hpp"
#include "simulation/traffic.hpp"

namespace laneloom::commands {
namespace {

std::vector<std::filesystem::path> logs_in(const std::string& directory, bool strict) {
  return read_and_warn(directory, strict,
                       [&](LeftOut& left_out) { return simulation::argoverse2_logs(directory, left_out); });
}

std::filesystem::path only_log(const std::string& directory, bool strict) {
  const std::vector<std::filesystem::path> logs = logs_in(directory, strict);
  if (logs.size() > 1)
    throw std::runtime_error(
        fmt::format("{}: holds {} logs; name one, as {}", directory, logs.size(), logs.front().string()));
  return logs.front();
}

}  // namespace

std::vector<RoadSource> RoadSource::each() const {
  if (argoverse2.empty()) return {*this};
  std::vector<RoadSource> sources;
  for (const auto& log : logs_in(argoverse2, strict)) {
    sources.push_back(*this);
    sources.back().argoverse2 = log.string();
  }
  return sources;
}

simulation::Road RoadSource::load() const {
  if (!argoverse2.empty()) {
    const std::filesystem::path log = only_log(argoverse2, strict);
    return read_and_warn(log, strict,
                         [&](LeftOut& left_out) { return simulation::load_argoverse2(log, left_out); });
  }
  if (!opendrive.empty())
    return read_and_warn(opendrive, strict, [&](LeftOut& left_out) {
      return simulation::load_opendrive(opendrive, speed_mps, left_out);
    });
  if (lanelet2.empty()) return simulation::make_scenario(scenario, speed_mps);
  return read_and_warn(lanelet2, strict, [&](LeftOut& left_out) {
    return simulation::load_lanelet2(lanelet2, speed_mps, left_out);
  });
}

simulation::Perception RoadSource::perception(const simulation::Road& road) const {
  return {road, noise.profile(), simulation::SensorView{}, seed};
}

Tracker RoadSource::tracker(const simulation::Road& road) const {
  if (traffic.empty()) return {};
  if (traffic != kRecordedTraffic) {
    simulation::Traffic others(road, simulation::traffic_profile(traffic), seed);
    return [others](const VehiclePose& pose, double) mutable { return others.observe(pose); };
  }
  if (argoverse2.empty())
    throw std::runtime_error("--traffic recorded: only a log (--argoverse2) has recorded traffic");
  const std::filesystem::path log = only_log(argoverse2, strict);
  // What is wrong with the poses was told when the road was loaded.
  LeftOut nothing_told;
  const std::vector<VehiclePose> poses = simulation::argoverse2_poses(log, nothing_told);
  auto objects = read_and_warn(
      log, strict, [&](LeftOut& left_out) { return simulation::argoverse2_objects(log, poses, left_out); });
  if (objects.empty()) return {};
  simulation::RecordedTraffic others(std::move(objects), road.drive, poses.front().stamp_ns);
  return [others](const VehiclePose& pose, double drive_s) mutable { return others.observe(pose, drive_s); };
}

void add_road_source(CLI::App& command, RoadSource& source) {
  CLI::Option_group* road = command.add_option_group("Road", "one of");
  road->add_option("--scenario", source.scenario, "A built-in road")
      ->check(CLI::IsMember(simulation::scenario_names()));
  road->add_option("--argoverse2", source.argoverse2,
                   "Directory of an Argoverse 2 log, driven as recorded, or of logs");
  road->add_option("--lanelet2", source.lanelet2, "A Lanelet2 map (.osm), driven along its lanes");
  road->add_option("--opendrive", source.opendrive,
                   "A road network of OpenDRIVE (.xodr), driven along its lanes");
  road->require_option(1);
  command.add_option("--speed", source.speed_mps, "Speed of the vehicle in m/s; recorded drives keep theirs")
      ->check(within(0.1, 60.0))
      ->capture_default_str();
  add_noise(command, source.noise);
  add_traffic(command, source.traffic, {kRecordedTraffic});
  command.add_option("--seed", source.seed, "Seed of the noise and the traffic")->capture_default_str();
  add_strict(command, source.strict);
}

}  // namespace laneloom::commands
