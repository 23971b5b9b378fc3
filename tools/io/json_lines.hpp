#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/left_out.hpp"
#include "io/text_file.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

/// Frames and maps as JSON, one per line. It is the simple interface for other tools. frame.schema.json and
/// tools/ten-minutes.md tell the same of frames.
///
/// A frame:
///
///     {"t": seconds, "pose": [x, y, z, qx, qy, qz, qw],
///      "detections": [{"type": "laneline" | "roadedge" | "stopline", "score": 0..1,
///                      "style": "solid" | "dashed" | "unknown", "points": [[x, y, z], …], "stddev": [σ, …]},
///                      …],
///      "stamp_ns": 1, "sequence": 1, "session_id": 1, "source": "…", "detected_types": ["laneline", …],
///      "field_of_view": [[x, y, z], …], "occluded_areas": [[[x, y, z], …], …],
///      "objects": [{"id": 1, "kind": "car", "position": [x, y, z], "heading": [x, y, z], "speed": 8.0,
///                   "existence": 0..1 or -1, "stddev": 0.3, "length": 4.5, "width": 1.8}, …],
///      "next_turn": {"turn": "unknown" | "straight" | "left" | "right" | "u_turn", "distance": 80}}
///
/// The pose is T_map_body at t, points are in the body frame, metres. A detection's style and stddev, and
/// everything from stamp_ns on, may be left out, and of an object all but id and position; stamp_ns is exact
/// where t is rounded. Time 0 is read as 1 ns, because a stamp of 0 means that there is none. Coordinates are
/// within 10 000 km.
///
/// A map:
///
///     {"t": seconds, "pose": […], "stamp_ns": 1,
///      "instances": [{"id": 1, "type": "…", "points": [[x, y, z], …], "styles": [[from, to, "solid"], …],
///                     "status": "tentative" | "confirmed" | "inferred", "existence": 0..1 or -1,
///                     "observations": 1, "first_seen_ns": 1, "last_seen_ns": 1, "lateral_stddev": [σ, …]},
///                     …],
///      "lanes": [{"id": 1, "left": [[x, y, z], …], "right": […], "centerline": […], "successors": [2, …],
///                 "left_borders": [{"boundary": 1 or 0, "range": [from, to], "on_boundary": [from, to]}, …],
///                 "right_borders": […], "left_neighbours": [{"lane": 2, "range": [from, to], "crossable":
///                 [[from, to], …]}, …], "right_neighbours": […], "width": 3.5, "section": 1,
///                 "direction": "unknown" | "along" | "against" | "both", "direction_probability": 0..1 or
///                 -1, "direction_evidence": ["markings", …], "use": "lane" | "shoulder" | "parking" |
///                 "cycle" | "unknown", "use_probability": -1, "status": "…", "existence": -1, "evidence":
///                 ["markings" | "edges" | "ego_path" | "traffic" | "sd_map", …], "inferred_ranges": [[from,
///                 to], …]}, …],
///      "linkages": [{"from": 1, "to": 2, "kind": "…", "turn": "…", "probability": 0..1, "evidence": […],
///                    "path": […]}, …],
///      "stoplines": [{"id": 1, "lanes": [1, …], "heading": [x, y, z]}, …],
///      "way": {"step": 1, "known": 40, "confirmed": 30, "lanes": [{"lane": 1, "against": false, "entry":
///              "straight", "range": [from, to]}, …], "stations": [{"point": [x, y, z], "heading": 0,
///              "curvature": 0, "lane": 1, "left": 1.7, "right": 1.8, "width": 3.5, "lateral_stddev": 0.1,
///              "status": "…", "may_change_left": true, "may_change_right": false}, …]},
///      "driven_paths": [{"id": 1, "points": […], "lateral_stddev": 0.6, "probability": 0..1}, …]}
///
/// Points are in the map frame. Instances are the boundaries and the stoplines' markings. Only t, pose,
/// instances, lanes, an instance's id, type and points, and a lane's id, left, right and centerline must be
/// there; without linkages, the successors are.
namespace laneloom::io {

/// A frame, and the vehicle's pose at its stamp.
struct FrameRecord {
  DetectionFrame frame;
  VehiclePose pose;
  std::optional<TrackedObjects> objects = {};  ///< at the frame's stamp; none: there is no tracker
  std::optional<NextTurn> next_turn = {};      ///< likewise; none: nothing is told anew
};

/// One line, without its end. All numbers must be finite.
std::string to_json_line(const FrameRecord& record);
std::string to_json_line(const LocalMap& map);

/// The type of marking that lines of each class become. None: they are left out.
using Classes = std::map<std::string, std::optional<MarkingType>>;

/// Conventions by which frames of others may differ from laneloom's.
struct FrameConventions {
  bool any_confidence = false;  ///< confidences may be on another scale than 0..1
  Classes classes{};            ///< what `type` may be beside laneloom's types
};

/// How a frame is read.
struct FrameReading {
  LeftOut& left_out;    ///< detections, objects and turns that are wrong are left out, unless that is strict
  std::string place{};  ///< of the frame, where something is left out
  FrameConventions conventions{};  ///< of the frame
};

/// All throw std::runtime_error naming the key if `text` is not such a line. It is not checked whether ids
/// that a map refers to are in it. `lineage` and `markings` of a map stay empty.
FrameRecord frame_from_json(std::string_view text);
FrameRecord frame_from_json(std::string_view text, const FrameReading& reading);
LocalMap map_from_json(std::string_view text);

/// A line of a file, without its end.
struct StampedLine {
  std::int64_t stamp_ns = 0;
  std::string text;
};

/// Reads a file line by line, skipping empty ones; "-" is standard input. Not thread-safe.
class JsonLinesReader {
 public:
  /// Throws std::runtime_error where the file cannot be read.
  explicit JsonLinesReader(const std::filesystem::path& path, FrameConventions conventions = {});

  /// The content of the next line. None: the end. Both throw std::runtime_error naming file, line number and
  /// key; reading may go on with the line after.
  std::optional<FrameRecord> next_frame();
  std::optional<LocalMap> next_map();
  /// The next line that is a frame, a map, or has a stamp at all. Others are left out, and detections and
  /// objects that are wrong, unless that is strict.
  std::optional<FrameRecord> next_frame(LeftOut& left_out);
  std::optional<LocalMap> next_map(LeftOut& left_out);
  std::optional<StampedLine> next_stamped(LeftOut& left_out);

  /// The share of the file that was read, 0..1.
  double progress() const;

 private:
  template <typename Read>
  auto next(LeftOut& left_out, Read read) -> std::optional<std::invoke_result_t<Read, const std::string&>>;
  bool next_line();
  void read_line();
  std::runtime_error error(const std::string& complaint) const;

  std::filesystem::path path_;
  FrameConventions conventions_;
  std::ifstream file_;
  std::istream text_;  ///< of the file or of standard input
  std::uintmax_t size_ = 0;
  std::uintmax_t bytes_read_ = 0;
  std::string line_;
  std::size_t number_ = 0;
  bool line_ended_ = false;  ///< by a line feed, and not by the end of the file
};

/// Writes a file line by line; "-" is standard output. Not thread-safe.
class JsonLinesWriter {
 public:
  /// Throws std::runtime_error where the file cannot be written.
  explicit JsonLinesWriter(const std::filesystem::path& path) : file_(path) {}
  /// All of these throw std::runtime_error if writing fails.
  void write(const FrameRecord& record) { write_line(to_json_line(record)); }
  void write(const LocalMap& map) { write_line(to_json_line(map)); }
  void write_line(const std::string& line);
  void close() { file_.close(); }

 private:
  TextFile file_;
};

}  // namespace laneloom::io
