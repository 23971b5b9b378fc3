#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiment/drive_simulation.hpp"
#include "export/drive_lines.hpp"
#include "export/survey.hpp"
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

/// A piece of a line that is believed, as it leaves the map at a drive's newest pose.
inline exports::ArchivedPiece piece_of(ElementId id, MarkingType type, const Polyline& points,
                                       const exports::DriveLines& drive) {
  return {.marking = {.id = id,
                      .type = type,
                      .points = points,
                      .lateral_stddev_m = std::vector<double>(points.size(), 0.1),
                      .existence_probability = 0.9,
                      .observations = 100},
          .pose = drive.poses.size() - 1};
}

inline exports::DriveLines lines_of(const std::vector<LocalMap>& maps, const RangeConfig& range) {
  exports::DriveAccumulator accumulator(range);
  for (const LocalMap& map : maps) accumulator.add(map);
  return accumulator.finish();
}

inline exports::SurveyedRoad surveyed(const MappedDrive& drive) {
  exports::Survey survey;
  survey.add(lines_of(drive.maps, drive.config.range));
  return survey.road();
}

}  // namespace laneloom::test
