#pragma once

#include <string>
#include <vector>

#include "drawing/drawing.hpp"

/// What the elements of map, frames and truth have in common.
namespace laneloom {

/// Whether a line has any extent.
bool drawable(const Polyline& line);

/// A line per stretch of a style.
std::vector<Shape> marking_shapes(const Marking& marking, double opacity);

/// What is sure is opaque; so is what was not estimated (-1).
double opacity_of(double existence_probability);

/// "boundaries/12"
std::string key_of(Layer layer, ElementId id);

}  // namespace laneloom
