#pragma once

#include <string>

#include "drawing/drawing.hpp"
#include "scene/foxglove.hpp"

namespace laneloom::scene {

/// The frame that a drawing's coordinates are in.
struct SceneFrame {
  std::string id;
  bool locked = false;  ///< whether the drawing moves with the frame
};

/// Appends the drawing's elements to `to`, with their keys as ids. Colours are those for a dark ground, which
/// these panels have by default. Points are relative to an origin near to the drawing's pose, because
/// graphics cards compute with few digits. Shapes that are painted later lie a little higher.
void append_entities(const drawing::Drawing& drawing, const SceneFrame& frame,
                     std::vector<foxglove::SceneEntity>& to);

}  // namespace laneloom::scene
