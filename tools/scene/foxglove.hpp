#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "drawing/colour.hpp"
#include "laneloom/types.hpp"

/// The part of Foxglove's schemas (docs.foxglove.dev/docs/sdk/schemas) that is written here, as plain data
/// and as bytes that the 3D panels of Foxglove and Lichtblick show. Lengths are in metres; frames are
/// right-handed.
namespace laneloom::scene::foxglove {

inline constexpr const char* kSceneUpdateType = "foxglove::SceneUpdate";
inline constexpr const char* kFrameTransformType = "foxglove::FrameTransform";
/// OMG IDL of both types as one text, without a line for a preprocessor.
extern const char* const kIdl;

enum class LineType : std::uint8_t { strip, loop, list };

/// A line, a closed line or a list of segments.
struct LinePrimitive {
  LineType type = LineType::strip;
  Point origin = Point::Zero();  ///< the points are relative to it
  double thickness_px = 1.0;
  Polyline points;  ///< in a list: two for each segment
  drawing::Colour colour;
};

/// An area made of triangles.
struct TrianglePrimitive {
  Point origin = Point::Zero();
  Polyline points;
  drawing::Colour colour;
  std::vector<std::uint32_t> indices;  ///< three for each triangle
};

/// A text that faces the viewer.
struct TextPrimitive {
  Point position = Point::Zero();  ///< of its middle
  double height_px = 12.0;
  drawing::Colour colour;
  std::string text;
};

/// Something to show. It replaces an entity of the same id on the same topic.
struct SceneEntity {
  std::string frame_id;
  std::string id;
  bool frame_locked = false;  ///< whether it moves with its frame
  std::vector<std::pair<std::string, std::string>> metadata;
  std::vector<LinePrimitive> lines;
  std::vector<TrianglePrimitive> triangles;
  std::vector<TextPrimitive> texts;
};

/// A message that deletes entities and then adds or replaces others.
struct SceneUpdate {
  std::int64_t time_ns = 0;          ///< by the clock of log times, which panels play by
  double lifetime_s = 0.0;           ///< of the entities; 0: until they are deleted
  std::vector<std::string> deleted;  ///< ids
  std::vector<SceneEntity> entities;
};

/// The pose of the frame `child` in the frame `parent`.
struct FrameTransform {
  std::int64_t time_ns = 0;
  std::string parent, child;
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
};

/// Plain CDR behind its encapsulation header. Times before 1970 or after 2106 are written as the nearest time
/// within. Pure functions.
std::vector<std::uint8_t> to_cdr(const SceneUpdate& update);
std::vector<std::uint8_t> to_cdr(const FrameTransform& transform);

}  // namespace laneloom::scene::foxglove
