#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiment/drive_simulation.hpp"
#include "export/accumulate.hpp"
#include "laneloom/mapper.hpp"
#include "simulation/noise_profile.hpp"
#include "simulation/scenarios.hpp"

namespace laneloom::test {

/// A simulated drive on a built-in road, once to its end, and its local maps.
struct MappedDrive {
  std::shared_ptr<const simulation::Road> road;
  MapperConfig config;
  std::vector<LocalMap> maps;
};

inline MappedDrive map_drive(const std::string& scenario, const std::string& noise) {
  MappedDrive drive{.road = std::make_shared<const simulation::Road>(simulation::make_scenario(scenario)),
                    .config = {},
                    .maps = {}};
  const experiment::DriveSpec spec{.road = drive.road, .noise = simulation::noise_profile(noise)};
  Mapper mapper(drive.config);
  for (const experiment::SimulatedFrame& frame : simulate(spec))
    drive.maps.push_back(mapper.update(frame.record.frame, transform(frame.record.pose)));
  return drive;
}

inline exports::DriveAccumulator::Drive accumulated(const MappedDrive& drive) {
  exports::DriveAccumulator accumulator(drive.config.range);
  for (const LocalMap& map : drive.maps) accumulator.add(map);
  return accumulator.finish();
}

}  // namespace laneloom::test
