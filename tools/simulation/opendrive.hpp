#pragma once

#include <filesystem>

#include "base/left_out.hpp"
#include "simulation/road.hpp"

namespace laneloom::simulation {

/// Loads a road network of OpenDRIVE (.xodr, 1.4 to 1.8) and drives a long way along its lanes, at constant
/// speed.
///
/// Coordinates are those of the file. Roads have line, arc, spiral, poly3 and paramPoly3, elevation, lane
/// offsets, lane sections, lanes by width or border, and road marks. Superelevation, shape, heights of lanes
/// and the outlines of junctions are not read. Lanes are those for vehicles (driving, entry, exit, ramps,
/// bus, taxi, HOV), on the side that the road's rule (RHT, LHT) says, and with the direction "reversed"
/// driven the other way. Solid marks are solid lanelines, broken ones and dots are dashed; marks of both
/// kinds in one are of unknown style; curb, edge and grass are roadedges. A border that is marked along
/// four fifths has the longest of its marks. Where what is paved ends without a mark outside of junctions,
/// there is a roadedge. Stop lines are objects of the type roadMark whose subtype is signalLines, or whose
/// name has StopLine. Lanes follow one another where their ends meet, whatever the links say. Traffic is that
/// of the greater part of the roads.
///
/// What is wrong is left out, with its road. Throws std::runtime_error naming the file if there are no lanes,
/// or neither lanelines nor roadedges; also naming the first wrong road if `left_out` is strict.
Road load_opendrive(const std::filesystem::path& xodr_file, double speed_mps, LeftOut& left_out);

}  // namespace laneloom::simulation
