#include "import/frame_collector.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "io/file_kind.hpp"
#include "io/json_fields.hpp"
#include "io/json_stream.hpp"
#include "session/gate.hpp"

namespace laneloom::imports {

using nlohmann::json;

namespace {

constexpr const char* kResults =
    "results of MapTR have a list `results` (laneloom import maptr), and those of StreamMapNet and "
    "MapTracker "
    "an object `results` (import streammapnet, import maptracker)";

}  // namespace

const Classes& usual_classes() {
  static const Classes classes{{"divider", MarkingType::laneline},
                               {"boundary", MarkingType::roadedge},
                               {"ped_crossing", std::nullopt},
                               {"centerline", std::nullopt}};
  return classes;
}

std::vector<MarkingType> types_of(const Classes& classes) {
  std::set<MarkingType> types;
  for (const auto& [name, type] : classes)
    if (type) types.insert(*type);
  return {types.begin(), types.end()};
}

std::string names_of(const Classes& classes) {
  std::string names;
  for (const auto& [name, type] : classes) names += (names.empty() ? "" : ", ") + name;
  return names;
}

double confidence(const json& value) {
  const double confidence = io::number(value);
  if (!(confidence >= 0.0 && confidence <= 1.0))
    throw io::JsonError("must be from 0 to 1; percentages have to be divided by 100");
  return confidence;
}

void check_line(const Detection& line) {
  constexpr std::int64_t kAnyStamp_ns = 1;
  const DetectionFrame frame{.stamp_ns = kAnyStamp_ns, .detections = {line}};
  if (const auto why = session::defect(frame, GateConfig{}); !why.empty())
    throw io::JsonError("the service would refuse this line: " + std::string(why));
}

void check_lines_are_left(const std::vector<DetectionFrame>& frames, std::size_t wrong_lines) {
  const bool no_line =
      std::ranges::all_of(frames, [](const DetectionFrame& frame) { return frame.detections.empty(); });
  if (no_line && wrong_lines > 0) throw std::runtime_error("no line is left, as lines are wrong");
}

FrameCollector::FrameCollector(const ResultsReading& reading, std::string source,
                               const Eigen::Isometry3d& T_drive_points)
    : drive_(reading.drive),
      left_out_(reading.left_out),
      classes_(reading.classes),
      T_body_points_(reading.drive.T_body_points * T_drive_points) {
  frame_.source = std::move(source);
  frame_.detected_types = types_of(classes_);
}

void FrameCollector::add_sample(const std::string& place, const std::function<void()>& read) {
  place_ = place;
  io::take_or_leave_out(left_out_, place, "", read);
}

void FrameCollector::add_line(std::size_t number, const std::function<void()>& read) {
  if (!io::take_or_leave_out(left_out_, place_ + ".", "vectors[" + std::to_string(number) + "]", read))
    ++wrong_lines_;
}

bool FrameCollector::begin(const std::string& sample) {
  const std::optional<std::int64_t> stamp_ns = drive_.stamp_ns_of(sample);
  if (!stamp_ns) {
    ++imported_.other_drives;
    return false;
  }
  if (stamps_.contains(*stamp_ns)) throw io::JsonError("a second one of this stamp");
  frame_.stamp_ns = *stamp_ns;
  frame_.detections.clear();
  return true;
}

std::optional<MarkingType> FrameCollector::type_of(const std::string& class_name) const {
  const auto found = classes_.find(class_name);
  if (found == classes_.end())
    throw io::JsonError("the class " + class_name + " is none of " + names_of(classes_) + " (see --class)");
  return found->second;
}

void FrameCollector::add(const std::string& class_name, double confidence, const json& points) {
  const std::optional<MarkingType> type = type_of(class_name);
  if (!type) {
    ++imported_.left_out[class_name];
    return;
  }
  Detection detection{.type = *type, .confidence = confidence};
  detection.points = io::list(points, [&](const json& point) { return in_body(point); });
  if (detection.points.size() < 2) throw io::JsonError("must have at least two points");
  check_line(detection);
  frame_.detections.push_back(std::move(detection));
}

void FrameCollector::end() {
  if (const auto why = session::defect(frame_, GateConfig{}); !why.empty())
    throw io::JsonError("the service would refuse this frame: " + std::string(why));
  stamps_.insert(frame_.stamp_ns);
  imported_.frames.push_back(frame_);
}

ImportedFrames FrameCollector::collect(const std::filesystem::path& file,
                                       const std::function<void()>& walk) && {
  if (const std::string kind = io::file_kind(file); !kind.empty())
    throw std::runtime_error(file.string() + ": " + kind + "; the results are needed as JSON");
  try {
    walk();
  } catch (const io::OtherJson& error) {
    throw std::runtime_error(std::string(error.what()) + "; " + kResults);
  } catch (const io::DamagedJson& damage) {
    if (left_out_.strict() || imported_.frames.empty()) throw;
    left_out_.add("the rest of the file, which is damaged or cut off", damage.where());
  }
  try {
    if (imported_.frames.empty()) throw std::runtime_error("has no sample of " + drive_.name);
    check_lines_are_left(imported_.frames, wrong_lines_);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  std::ranges::sort(imported_.frames, {}, &DetectionFrame::stamp_ns);
  return std::move(imported_);
}

Point FrameCollector::in_body(const json& value) const {
  if (value.is_array() && value.size() == 3) return T_body_points_ * io::point(value);
  if (!value.is_array() || value.size() != 2) throw io::JsonError("must be [x, y] or [x, y, z]");
  Point body = T_body_points_ * Point(io::number(value[0]), io::number(value[1]), 0.0);
  body.z() = drive_.ground_z_m;
  return body;
}

}  // namespace laneloom::imports
