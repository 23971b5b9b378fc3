#pragma once

#include <string>
#include <vector>

#include "simulation/road.hpp"

/// Made-up roads, each of one difficulty, and a town that joins them. Right-hand traffic.
namespace laneloom::simulation {

/// The names straight, curve, street, country_road, motorway, split, merge, t_intersection, intersection,
/// hill, overpass and town.
std::vector<std::string> scenario_names();

/// A built-in road, driven at constant speed. The town's drive is closed, so that it can be repeated. Throws
/// std::invalid_argument if the name is unknown, listing the known ones, or if the speed is not positive.
Road make_scenario(const std::string& name, double speed_mps = 10.0);

}  // namespace laneloom::simulation
