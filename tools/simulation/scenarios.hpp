#pragma once

#include <string>
#include <vector>

#include "simulation/road.hpp"

/// Made-up roads, each of one difficulty, and a town that joins them. Right-hand traffic.
namespace laneloom {

/// straight, curve, street, country_road, motorway, split, merge, t_intersection, intersection, hill,
/// overpass, town.
std::vector<std::string> scenario_names();

/// A built-in road, driven at constant speed. The town's drive is closed: it can go round and round.
/// Throws std::invalid_argument naming the known ones where the name is unknown, or the speed not positive.
Road make_scenario(const std::string& name, double speed_mps = 10.0);

}  // namespace laneloom
