#include "commands/road_list.hpp"

#include "commands/options.hpp"
#include "simulation/argoverse2.hpp"
#include "simulation/lanelet2.hpp"
#include "simulation/scenarios.hpp"

namespace laneloom::commands {

std::vector<experiment::DriveSpec> RoadList::drives(
    const std::vector<simulation::NoiseProfile>& noises) const {
  std::vector<std::shared_ptr<const simulation::Road>> roads;
  const auto add = [&](simulation::Road road) {
    roads.push_back(std::make_shared<const simulation::Road>(std::move(road)));
  };
  for (const std::string& name : scenarios) add(simulation::make_scenario(name, speed_mps));
  LeftOut left_out;
  for (const std::string& directory : argoverse2)
    for (const auto& log : simulation::argoverse2_logs(directory, left_out))
      add(simulation::load_argoverse2(log));
  for (const std::string& file : lanelet2) add(simulation::load_lanelet2(file, speed_mps));
  const auto profile = traffic.empty() ? std::nullopt : std::optional(simulation::traffic_profile(traffic));
  std::vector<experiment::DriveSpec> drives;
  drives.reserve(roads.size() * noises.size() * seeds.size());
  for (const auto& road : roads) {
    for (const simulation::NoiseProfile& noise : noises) {
      for (const std::uint64_t seed : seeds)
        drives.push_back({.road = road,
                          .noise = noise,
                          .seed = seed,
                          .duration_s = duration_s,
                          .drift = drift,
                          .traffic = profile});
    }
  }
  return drives;
}

void add_roads(CLI::App& command, RoadList& roads) {
  CLI::Option_group* road = command.add_option_group("Roads", "any number of");
  road->add_option("--scenario", roads.scenarios, "A built-in road")
      ->check(CLI::IsMember(simulation::scenario_names()));
  road->add_option("--argoverse2", roads.argoverse2, "Directory of an Argoverse 2 log, or of logs");
  road->add_option("--lanelet2", roads.lanelet2, "A Lanelet2 map (.osm), driven along its lanes");
  road->require_option(1, 0);
  command.add_option("--seeds", roads.seeds, "Seeds of the noise; every road is driven with each")
      ->delimiter(',')
      ->capture_default_str();
  command.add_option("--drift", roads.drift, "Drift of the odometry, as a share of the distance driven")
      ->check(within(0.0, 0.2));
}

void add_road_list(CLI::App& command, RoadList& roads) {
  add_roads(command, roads);
  command.add_option("--speed", roads.speed_mps, "Speed in m/s; recorded drives keep theirs")
      ->check(within(0.1, 60.0))
      ->capture_default_str();
  command.add_option("--duration", roads.duration_s, "Seconds per drive; one that is not closed ends sooner")
      ->check(positive_seconds())
      ->capture_default_str();
}

}  // namespace laneloom::commands
