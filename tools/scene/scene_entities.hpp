#pragma once

#include <string>

#include "drawing/drawing.hpp"
#include "scene/foxglove.hpp"

namespace laneloom {

/// The frame that a drawing's coordinates are in.
struct SceneFrame {
  std::string id;
  bool locked = false;  ///< what is drawn moves with the frame
};

/// Appends the drawing's elements, their keys as ids. Colours are those for a dark ground, which these panels
/// have by default. Points are relative to an origin near to the drawing's pose, as graphics cards compute
/// with few digits; what is painted later lies a little higher. Pure but for `to`.
void append_entities(const Drawing& drawing, const SceneFrame& frame, std::vector<foxglove::SceneEntity>& to);

}  // namespace laneloom
