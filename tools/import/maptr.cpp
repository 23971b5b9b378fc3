#include "import/maptr.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>

#include "io/json_fields.hpp"
#include "io/json_stream.hpp"
#include "session/gate.hpp"

namespace laneloom {
namespace {

using nlohmann::json;

/// None: laneloom has no use for the class.
std::optional<MarkingType> type_of_class(const std::string& class_name) {
  if (class_name == "divider") return MarkingType::laneline;
  if (class_name == "boundary") return MarkingType::roadedge;
  if (class_name == "ped_crossing" || class_name == "centerline") return std::nullopt;
  throw JsonError("cls_name", "must be divider, boundary, ped_crossing or centerline, and is " + class_name);
}

double confidence(const json& value) {
  const double confidence = number(value);
  if (!(confidence >= 0.0 && confidence <= 1.0)) throw JsonError("must be from 0 to 1");
  return confidence;
}

class FrameReader {
 public:
  explicit FrameReader(const DriveLog& drive) : drive_(drive) {}

  void read(const json& result) {
    const auto sample = required(result, "sample_token", text);
    const std::optional<std::int64_t> stamp_ns = drive_.stamp_ns_of(sample);
    if (!stamp_ns) {
      ++imported_.other_drives;
      return;
    }
    if (!stamps_.insert(*stamp_ns).second) throw JsonError("sample_token", "a second one of this stamp");
    DetectionFrame frame{.stamp_ns = *stamp_ns,
                         .source = "maptr",
                         .detected_types = {MarkingType::laneline, MarkingType::roadedge}};
    required(result, "vectors", [&](const json& vectors) {
      return list(vectors, [&](const json& vector) { return add(vector, frame); });
    });
    if (const auto why = defect(frame, GateConfig{}); !why.empty())
      throw JsonError("the service would refuse this frame: " + std::string(why));
    imported_.frames.push_back(std::move(frame));
  }

  ImportedFrames finish() && {
    std::sort(imported_.frames.begin(), imported_.frames.end(),
              [](const DetectionFrame& a, const DetectionFrame& b) { return a.stamp_ns < b.stamp_ns; });
    return std::move(imported_);
  }

 private:
  /// Whether the line is of use.
  bool add(const json& vector, DetectionFrame& frame) {
    const auto class_name = required(vector, "cls_name", text);
    const std::optional<MarkingType> type = type_of_class(class_name);
    if (!type) {
      ++imported_.left_out[class_name];
      return false;
    }
    Detection detection{.type = *type, .confidence = required(vector, "confidence_level", confidence)};
    detection.points = required(vector, "pts", [&](const json& points) {
      return list(points, [&](const json& point) { return in_body(point); });
    });
    if (detection.points.size() < 2) throw JsonError("pts", "must have at least two points");
    frame.detections.push_back(std::move(detection));
    return true;
  }

  Point in_body(const json& value) const {
    if (value.is_array() && value.size() == 3) return drive_.T_body_points * point(value);
    if (!value.is_array() || value.size() != 2) throw JsonError("must be [x, y] or [x, y, z]");
    Point body = drive_.T_body_points * Point(number(value[0]), number(value[1]), 0.0);
    body.z() = drive_.ground_z_m;
    return body;
  }

  const DriveLog& drive_;
  ImportedFrames imported_;
  std::set<std::int64_t> stamps_;
};

}  // namespace

ImportedFrames read_maptr(const std::filesystem::path& path, const DriveLog& drive) {
  FrameReader reader(drive);
  for_each_json_object(path, "results", [&](const json& result) { reader.read(result); });
  ImportedFrames imported = std::move(reader).finish();
  if (imported.frames.empty()) throw std::runtime_error(path.string() + ": has no sample of " + drive.name);
  return imported;
}

}  // namespace laneloom
