#include "import/openpilot.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

#include "io/json_fields.hpp"
#include "session/gate.hpp"

namespace laneloom::imports {
namespace {

using nlohmann::json;

/// Takes forward, right, down to forward, left, up, and back.
const Eigen::DiagonalMatrix<double, 3> kTurned(1.0, -1.0, -1.0);

/// Reads an integer of 64 bits, which Cap'n Proto writes as a text.
std::int64_t long_integer(const json& value) {
  if (!value.is_string()) return io::integer(value);
  const auto& digits = value.get_ref<const std::string&>();
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) throw io::JsonError("must be an integer");
  return number;
}

/// Reads a vector: [x, y, z], or an object of x, y and z.
Eigen::Vector3d vector(const json& value) {
  if (value.is_array()) return io::point(value);
  return {io::required(value, "x", io::number), io::required(value, "y", io::number),
          io::required(value, "z", io::number)};
}

Eigen::Matrix3d rotation(const Eigen::Vector3d& roll_pitch_yaw) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(roll_pitch_yaw.z(), Point::UnitZ()) * AngleAxisd(roll_pitch_yaw.y(), Point::UnitY()) *
          AngleAxisd(roll_pitch_yaw.x(), Point::UnitX()))
      .toRotationMatrix();
}

/// A value, and whether openpilot believes it. It is an object of x, y and z in livePose, and a list in
/// liveLocationKalman.
struct Measurement {
  Eigen::Vector3d value;
  bool valid = false;
};

Measurement measurement(const json& object) {
  const bool valid = io::required(object, "valid", io::boolean);
  if (!valid) return {};
  return {object.contains("value") ? io::required(object, "value", vector) : vector(object), true};
}

struct Odometry {
  Eigen::Matrix3d T_ned_device;
  Eigen::Vector3d velocity_ned;  ///< m/s
};

class LogReader {
 public:
  void read(const json& event) {
    if (!event.is_object()) throw io::JsonError("must be an object");
    const std::int64_t stamp_ns = io::required(event, "logMonoTime", long_integer);
    const bool valid = io::optional(event, "valid", io::boolean).value_or(true);
    io::optional(event, "modelV2", [&](const json& model) { return read_model(model, valid); });
    for (const char* name : {"livePose", "liveLocationKalman"})
      io::optional(event, name, [&](const json& pose) { return read_pose(pose, stamp_ns, valid); });
    io::optional(event, "liveCalibration",
                 [&](const json& calibration) { return read_calibration(calibration, stamp_ns); });
  }

  OpenpilotDrive finish() && {
    for (auto& [stamp_ns, frame] : frames_) drive_.frames.push_back(std::move(frame));
    if (drive_.frames.empty()) throw std::runtime_error("has no valid modelV2");
    add_poses();
    if (drive_.poses.size() < 2)
      throw std::runtime_error("has fewer than two valid livePose or liveLocationKalman");
    return std::move(drive_);
  }

 private:
  // Each returns whether the event was used.
  bool read_model(const json& model, bool valid) {
    if (!valid) {
      ++drive_.invalid_frames;
      return false;
    }
    DetectionFrame frame{.stamp_ns = io::required(model, "timestampEof", long_integer),
                         .source = "openpilot",
                         .detected_types = {MarkingType::laneline, MarkingType::roadedge}};
    add(lines(model, "laneLines", MarkingType::laneline, io::required(model, "laneLineProbs", io::numbers),
              io::required(model, "laneLineStds", io::numbers)),
        frame);
    const auto deviations = io::required(model, "roadEdgeStds", io::numbers);
    std::vector<double> confidences;
    for (const double deviation_m : deviations)
      confidences.push_back(std::clamp(1.0 - deviation_m, 0.0, 1.0));
    add(lines(model, "roadEdges", MarkingType::roadedge, confidences, deviations), frame);
    if (const auto why = session::defect(frame, GateConfig{}); !why.empty())
      throw io::JsonError("the service would refuse this frame: " + std::string(why));
    if (!frames_.emplace(frame.stamp_ns, frame).second)
      throw io::JsonError("timestampEof", "a second frame of this stamp");
    return true;
  }

  static std::vector<Detection> lines(const json& model, const char* key, MarkingType type,
                                      const std::vector<double>& confidences,
                                      const std::vector<double>& deviations) {
    const auto all = io::required(model, key, [](const json& value) { return io::list(value, points); });
    if (all.size() != deviations.size() || all.size() != confidences.size())
      throw io::JsonError(key, "must be as many as their probabilities and standard deviations");
    std::vector<Detection> lines;
    for (std::size_t i = 0; i < all.size(); ++i)
      lines.push_back({.type = type,
                       .confidence = confidences[i],
                       .points = all[i],
                       .stddev_m = std::vector<double>(all[i].size(), deviations[i])});
    return lines;
  }

  static void add(std::vector<Detection>&& lines, DetectionFrame& frame) {
    std::ranges::move(lines, std::back_inserter(frame.detections));
  }

  static Polyline points(const json& line) {
    const auto x = io::required(line, "x", io::numbers), y = io::required(line, "y", io::numbers),
               z = io::required(line, "z", io::numbers);
    if (x.size() != y.size() || x.size() != z.size()) throw io::JsonError("x, y and z must be equally many");
    Polyline points;
    for (std::size_t i = 0; i < x.size(); ++i) points.push_back(kTurned * Point(x[i], y[i], z[i]));
    return points;
  }

  bool read_pose(const json& pose, std::int64_t stamp_ns, bool valid) {
    const Measurement orientation = io::required(pose, "orientationNED", measurement);
    const Measurement velocity = io::required(pose, "velocityDevice", measurement);
    if (!valid || !orientation.valid || !velocity.valid) {
      ++drive_.invalid_poses;
      return false;
    }
    const Eigen::Matrix3d T_ned_device = rotation(orientation.value);
    odometry_[stamp_ns] = {T_ned_device, T_ned_device * velocity.value};
    return true;
  }

  bool read_calibration(const json& calibration, std::int64_t stamp_ns) {
    if (io::required(calibration, "calStatus", io::text) != "calibrated") return false;
    calibrations_[stamp_ns] = rotation(io::required(calibration, "rpyCalib", io::point));
    return true;
  }

  /// The newest calibration at a stamp. Before the first calibration, it is the first one.
  Eigen::Matrix3d T_device_calibrated(std::int64_t stamp_ns) const {
    if (calibrations_.empty()) return Eigen::Matrix3d::Identity();
    const auto after = calibrations_.upper_bound(stamp_ns);
    return after == calibrations_.begin() ? after->second : std::prev(after)->second;
  }

  void add_poses() {
    Point position_ned = Point::Zero();
    for (auto now = odometry_.begin(); now != odometry_.end(); ++now) {
      if (now != odometry_.begin()) {
        const auto before = std::prev(now);
        const double step_s = 1e-9 * static_cast<double>(now->first - before->first);
        position_ned += 0.5 * step_s * (before->second.velocity_ned + now->second.velocity_ned);
      }
      const Eigen::Matrix3d turned(kTurned);
      const Eigen::Matrix3d T_ned_calibrated = now->second.T_ned_device * T_device_calibrated(now->first);
      VehiclePose pose{.stamp_ns = now->first, .position = kTurned * position_ned};
      pose.orientation = Eigen::Quaterniond(Eigen::Matrix3d(turned * T_ned_calibrated * turned)).normalized();
      if (const auto why = session::defect(pose, GateConfig{}); !why.empty())
        throw std::runtime_error("the service would refuse a pose: " + std::string(why));
      drive_.poses.push_back(pose);
    }
  }

  OpenpilotDrive drive_;
  std::map<std::int64_t, DetectionFrame> frames_;         ///< by stamp, as logs are not in its order
  std::map<std::int64_t, Odometry> odometry_;             ///< likewise
  std::map<std::int64_t, Eigen::Matrix3d> calibrations_;  ///< T_device_calibrated, likewise
};

}  // namespace

OpenpilotDrive read_openpilot(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  LogReader log;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty()) continue;
    try {
      log.read(io::parse_json(line));
    } catch (const io::JsonError& error) {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (in.bad()) throw std::runtime_error(path.string() + ": cannot be read");
  try {
    return std::move(log).finish();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace laneloom::imports
