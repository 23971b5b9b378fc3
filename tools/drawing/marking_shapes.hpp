#pragma once

#include <string>
#include <vector>

#include "drawing/drawing.hpp"

/// Functions for the elements of maps, frames and truth alike.
namespace laneloom::drawing {

/// Whether a line has any extent.
bool drawable(const Polyline& line);

/// The shapes of a marking: one line for each stretch of a style.
std::vector<Shape> marking_shapes(const Marking& marking, double opacity);

/// The shapes of a drawable line that ends with an arrow.
std::vector<Shape> arrow_along(const Polyline& line, Style style, double opacity = 1.0);

/// The opacity for an existence probability: the surer the more opaque. A probability that was not estimated
/// (-1) is opaque.
double opacity_of(double existence_probability);

/// The key of an element, such as "boundaries/12".
std::string key_of(Layer layer, ElementId id);

}  // namespace laneloom::drawing
