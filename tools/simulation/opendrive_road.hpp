#pragma once

#include <pugixml.hpp>

#include "simulation/borders.hpp"
#include "simulation/road.hpp"

namespace laneloom::simulation {

/// The lanes and markings of one road of OpenDRIVE, with ids of its own, and its side of traffic.
/// Successors are not known yet. Throws BadElement if something in it is wrong.
Road read_opendrive_road(const pugi::xml_node& element, LengthLimit& limit);

}  // namespace laneloom::simulation
