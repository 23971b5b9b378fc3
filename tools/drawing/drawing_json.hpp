#pragma once

#include <nlohmann/json.hpp>

#include "drawing/drawing.hpp"

/// A drawing as JSON, for a viewer seen from above: points have no z, and are rounded to a centimetre.
///
///     {"stamp_ns": "1", "pose": [x, y, heading],
///      "elements": [{"layer": "boundaries", "key": "boundaries/12", "id": 12, "type": "laneline",
///                    "status": "confirmed", "properties": {…},
///                    "shapes": [{"line": [x, y, x, y, …], "style": "laneline_dashed", "opacity": 0.8},
///                               {"area": [x, y, …], …}, {"arrow": [x, y, direction], …},
///                               {"text": "12", "at": [x, y], …}]}, …],
///      "lineage": [{"kind": "merged_into", "id": 12, "other": 5}, …]}
///
/// Lengths are in metres, angles in radians, both in the map frame. Elements are in the order of painting.
/// stamp_ns is text, because a number of JavaScript does not hold it; ids are counted up, and stay exact
/// below 2^53. id, status, properties, opacity (1) and lineage are left out if there is none.
namespace laneloom::drawing {

nlohmann::json to_json(const Drawing& drawing);

/// The palette as JSON:
///
///     {"layers": [{"name": "lanes", "title": "lanes", "shown": true, "overlay": 1.0}, …],
///      "styles": {"linkage": {"light": "#cc00bfff", "dark": "#rrggbbaa", "width": 1.8, "dash": [9, 7],
///                             "head": 9, "text": 11}, …},
///      "light": {"ground": "#…", "text": "#…", "faint": "#…"}, "dark": {…}}
///
/// Layers are in the order of painting. Widths, dashes, heads and texts are in pixels, and left out if there
/// is none.
nlohmann::json palette_json();

}  // namespace laneloom::drawing
