#pragma once

#include <vector>

#include "simulation/road.hpp"

/// Ways through a road's lanes.
namespace laneloom::simulation {

/// The lane whose centerline is nearest to a point, heights included; of equals, the first. The road must
/// have lanes.
std::size_t nearest_lane(const Road& road, const Point& point);

/// Indices of the fewest lanes that lead from one lane to another by successors, both included. Empty: there
/// is no way. From a lane to itself it is the shortest round.
std::vector<std::size_t> shortest_way(const Road& road, std::size_t from, std::size_t to);

/// A long way by successors that passes no lane more than twice: the longest of many seeded tries, the same
/// every time. The road must have lanes.
std::vector<std::size_t> long_way(const Road& road);

/// The centerlines of successive lanes as one path.
Polyline joined_centerlines(const Road& road, const std::vector<std::size_t>& lanes);

}  // namespace laneloom::simulation
