#include "scene/foxglove.hpp"

namespace laneloom::scene::foxglove {

// The names and types are those of Foxglove's schemas, as readers find the fields by their names.
const char* const kIdl = R"idl(module foxglove {

enum LineType { LINE_STRIP, LINE_LOOP, LINE_LIST };
enum SceneEntityDeletionType { MATCHING_ID, ALL };

@final
struct Time {
  unsigned long sec;
  unsigned long nsec;
};

@final
struct Duration {
  long sec;
  unsigned long nsec;
};

@final
struct Vector3 {
  double x;
  double y;
  double z;
};

@final
struct Point3 {
  double x;
  double y;
  double z;
};

@final
struct Quaternion {
  double x;
  double y;
  double z;
  double w;
};

@final
struct Pose {
  Vector3 position;
  Quaternion orientation;
};

@final
struct Color {
  double r;
  double g;
  double b;
  double a;
};

@final
struct KeyValuePair {
  string key;
  string value;
};

@final
struct ArrowPrimitive {
  Pose pose;
  double shaft_length;
  double shaft_diameter;
  double head_length;
  double head_diameter;
  Color color;
};

@final
struct CubePrimitive {
  Pose pose;
  Vector3 size;
  Color color;
};

@final
struct SpherePrimitive {
  Pose pose;
  Vector3 size;
  Color color;
};

@final
struct CylinderPrimitive {
  Pose pose;
  Vector3 size;
  double bottom_scale;
  double top_scale;
  Color color;
};

@final
struct LinePrimitive {
  LineType type;
  Pose pose;
  double thickness;
  boolean scale_invariant;
  sequence<Point3> points;
  Color color;
  sequence<Color> colors;
  sequence<unsigned long> indices;
};

@final
struct TriangleListPrimitive {
  Pose pose;
  sequence<Point3> points;
  Color color;
  sequence<Color> colors;
  sequence<unsigned long> indices;
};

@final
struct TextPrimitive {
  Pose pose;
  boolean billboard;
  double font_size;
  boolean scale_invariant;
  Color color;
  string text;
};

@final
struct ModelPrimitive {
  Pose pose;
  Vector3 scale;
  Color color;
  boolean override_color;
  string url;
  string media_type;
  sequence<octet> data;
};

@final
struct SceneEntityDeletion {
  Time timestamp;
  SceneEntityDeletionType type;
  string id;
};

@final
struct SceneEntity {
  Time timestamp;
  string frame_id;
  string id;
  Duration lifetime;
  boolean frame_locked;
  sequence<KeyValuePair> metadata;
  sequence<ArrowPrimitive> arrows;
  sequence<CubePrimitive> cubes;
  sequence<SpherePrimitive> spheres;
  sequence<CylinderPrimitive> cylinders;
  sequence<LinePrimitive> lines;
  sequence<TriangleListPrimitive> triangles;
  sequence<TextPrimitive> texts;
  sequence<ModelPrimitive> models;
};

@final
struct SceneUpdate {
  sequence<SceneEntityDeletion> deletions;
  sequence<SceneEntity> entities;
};

@final
struct FrameTransform {
  Time timestamp;
  string parent_frame_id;
  string child_frame_id;
  Vector3 translation;
  Quaternion rotation;
};

};
)idl";

}  // namespace laneloom::scene::foxglove
