#include "import/openpilot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

#include "base/distribution.hpp"
#include "base/seconds.hpp"
#include "import/frame_collector.hpp"
#include "import/openpilot_odometry.hpp"
#include "io/file_kind.hpp"
#include "io/json_fields.hpp"
#include "io/share_read.hpp"
#include "session/gate.hpp"

namespace laneloom::imports {
namespace {

using nlohmann::json;

constexpr const char* kNeeded =
    "the rlog is needed, as JSON with one event a line (capnp convert --short binary:json)";
constexpr double kMostBetweenFrames_s = 0.5;  // a log has 20 frames a second
constexpr double kFewestModels = 0.5;         // for each drivingModelData

/// Reads an integer of 64 bits, which Cap'n Proto writes as a text.
std::int64_t long_integer(const json& value) {
  if (!value.is_string()) return io::integer(value);
  const auto& digits = value.get_ref<const std::string&>();
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) throw io::JsonError("must be an integer");
  return number;
}

Polyline points(const json& line) {
  const auto x = io::required(line, "x", io::numbers), y = io::required(line, "y", io::numbers),
             z = io::required(line, "z", io::numbers);
  if (x.size() != y.size() || x.size() != z.size()) throw io::JsonError("x, y and z must be equally many");
  Polyline points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back(kTurned * Point(x[i], y[i], z[i]));
  return points;
}

/// A kind of lines in modelV2.
struct LinesOfModel {
  std::string lines, confidences, deviations;  ///< keys
  double (*confidence)(const json& value);
};

double edge_confidence(const json& deviation_m) {
  return std::clamp(1.0 - io::number(deviation_m), 0.0, 1.0);
}

/// A list of a model. Cap'n Proto writes no list where one was never set, which is as an empty one.
const json& list_in(const json& model, const std::string& key) {
  static const json empty = json::array();
  return *io::optional(model, key.c_str(), io::array).value_or(&empty);
}

const LinesOfModel kLaneLines{"laneLines", "laneLineProbs", "laneLineStds", confidence};
const LinesOfModel kRoadEdges{"roadEdges", "roadEdgeStds", "roadEdgeStds", edge_confidence};

class LogReader {
 public:
  explicit LogReader(const OpenpilotReading& reading)
      : left_out_(reading.left_out), classes_(reading.classes), types_(types_of(reading.classes)) {}

  /// Takes an event, which is at `place`.
  void read(const json& event, const std::string& place) {
    if (!event.is_object()) throw io::JsonError("must be an object");
    const std::int64_t stamp_ns = io::required(event, "logMonoTime", long_integer);
    has_events_ = true;
    if (event.contains("drivingModelData")) ++drive_.driving_models;
    const bool valid = io::optional(event, "valid", io::boolean).value_or(true);
    io::optional(event, "modelV2", [&](const json& model) { return read_model(model, valid, place); });
    for (const char* name : {"livePose", "liveLocationKalman"})
      io::optional(event, name, [&](const json& pose) { return read_pose(pose, stamp_ns, valid); });
    io::optional(event, "liveCalibration", [&](const json& calibration) {
      odometry_.add_calibration(calibration, stamp_ns);
      return true;
    });
  }

  /// Takes note that the log ends within an event.
  void cut_off() { cut_off_ = true; }

  OpenpilotDrive finish() && {
    for (auto& [stamp_ns, frame] : frames_) drive_.frames.push_back(std::move(frame));
    if (drive_.frames.empty()) throw std::runtime_error(why_no_frames());
    drive_.poses = odometry_.poses(left_out_);
    if (drive_.poses.size() < 2)
      throw std::runtime_error("has fewer than two valid livePose or liveLocationKalman");
    check_lines_are_left(drive_.frames, wrong_lines_);
    return std::move(drive_);
  }

 private:
  std::string why_no_frames() const {
    if (!has_events_) return std::string("has no event of openpilot; ") + kNeeded;
    if (drive_.models > 0) return "has no valid modelV2";
    // In an rlog, one may come before the first modelV2, in which the log is cut off.
    if (drive_.driving_models > (cut_off_ ? 1U : 0U))
      return std::string("is a qlog: it has drivingModelData, and no modelV2; ") + kNeeded;
    if (cut_off_) return "has no modelV2 before the place where it is cut off";
    return std::string("has no modelV2, as qlogs have none; ") + kNeeded;
  }

  bool read_model(const json& model, bool valid, const std::string& place) {
    ++drive_.models;
    if (!valid) {
      ++drive_.invalid_frames;
      return false;
    }
    DetectionFrame frame{.stamp_ns = io::required(model, "timestampEof", long_integer),
                         .source = "openpilot",
                         .detected_types = types_};
    // Before its lines, so that those of a frame that is given twice are not counted again.
    if (frames_.contains(frame.stamp_ns)) throw io::JsonError("timestampEof", "a second frame of this stamp");
    // A frame may lack one of them, but a model without both is none that is known.
    if (!io::optional(model, kRoadEdges.lines.c_str(), io::array))
      io::required(model, kLaneLines.lines.c_str(), io::array);
    add_lines(model, kLaneLines, place, frame);
    add_lines(model, kRoadEdges, place, frame);
    if (const auto why = session::defect(frame, GateConfig{}); !why.empty())
      throw io::JsonError("the service would refuse this frame: " + std::string(why));
    frames_.emplace(frame.stamp_ns, std::move(frame));
    return true;
  }

  void add_lines(const json& model, const LinesOfModel& kind, const std::string& place,
                 DetectionFrame& frame) {
    const std::optional<MarkingType> type = classes_.at(kind.lines);
    if (!type) return;
    const json& lines = list_in(model, kind.lines);
    const json& confidences = list_in(model, kind.confidences);
    const json& deviations = list_in(model, kind.deviations);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string key = kind.lines + "[" + std::to_string(i) + "]";
      const bool taken = io::take_or_leave_out(left_out_, place + ": modelV2.", key, [&] {
        if (i >= confidences.size()) throw io::JsonError("has no value in " + kind.confidences);
        if (i >= deviations.size()) throw io::JsonError("has no value in " + kind.deviations);
        Detection line{
            .type = *type, .confidence = kind.confidence(confidences[i]), .points = points(lines[i])};
        line.stddev_m.assign(line.points.size(), io::number(deviations[i]));
        check_line(line);
        frame.detections.push_back(std::move(line));
      });
      if (!taken) ++wrong_lines_;
    }
  }

  bool read_pose(const json& pose, std::int64_t stamp_ns, bool valid) {
    const bool used = valid && odometry_.add_pose(pose, stamp_ns);
    if (!used) ++drive_.invalid_poses;
    return used;
  }

  LeftOut& left_out_;
  const Classes& classes_;
  std::vector<MarkingType> types_;  ///< of the classes
  OpenpilotDrive drive_;
  std::map<std::int64_t, DetectionFrame> frames_;  ///< by stamp, as logs are not in its order
  std::size_t wrong_lines_ = 0;
  OpenpilotOdometry odometry_;
  bool has_events_ = false, cut_off_ = false;
};

/// Reads a line. `is_last`: nothing comes behind it, and not even its end.
void read_line(const std::string& line, bool is_last, const std::string& place, LogReader& log,
               LeftOut& left_out) {
  json event;
  try {
    event = io::parse_json(line);
  } catch (const io::JsonError& error) {
    if (left_out.strict()) throw;
    if (is_last) log.cut_off();
    left_out.add(is_last ? "the last line is cut off" : error.reason(), place);
    return;
  }
  io::take_or_leave_out(left_out, place, "", [&] { log.read(event, place); });
}

void read_lines(const std::filesystem::path& path, LogReader& log, const OpenpilotReading& reading) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  const io::ShareRead share(in, path);
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      read_line(line, in.eof(), "line " + std::to_string(number), log, reading.left_out);
    } catch (const io::JsonError& error) {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": " + error.what());
    }
    reading.on_step(share.now());
  }
  if (in.bad()) throw std::runtime_error(path.string() + ": cannot be read");
}

}  // namespace

const Classes& openpilot_classes() {
  static const Classes classes{{kLaneLines.lines, MarkingType::laneline},
                               {kRoadEdges.lines, MarkingType::roadedge}};
  return classes;
}

std::string why_qlog(const OpenpilotDrive& drive) {
  // The model writes both of them for each picture. A qlog has the smaller one.
  if (kFewestModels * static_cast<double>(drive.driving_models) > static_cast<double>(drive.models))
    return fmt::format(
        "looks like a qlog, with {} modelV2 beside {} drivingModelData; the rlog has all frames",
        drive.models, drive.driving_models);
  Distribution gaps_s;
  for (std::size_t i = 1; i < drive.frames.size(); ++i)
    gaps_s.add(seconds(drive.frames[i].stamp_ns - drive.frames[i - 1].stamp_ns));
  const double usual_s = gaps_s.quantile(0.5);
  if (!(usual_s > kMostBetweenFrames_s)) return {};
  return fmt::format("looks like a qlog, with a frame every {:.1f} s; the rlog has all frames", usual_s);
}

OpenpilotDrive read_openpilot(const std::filesystem::path& path, const OpenpilotReading& reading) {
  if (const std::string kind = io::file_kind(path); !kind.empty())
    throw std::runtime_error(path.string() + ": " + kind + "; " + kNeeded);
  LogReader log(reading);
  read_lines(path, log, reading);
  try {
    return std::move(log).finish();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace laneloom::imports
