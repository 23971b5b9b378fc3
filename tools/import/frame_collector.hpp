#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/left_out.hpp"
#include "import/drive_log.hpp"
#include "io/json_lines.hpp"
#include "laneloom/types.hpp"

namespace laneloom::imports {

/// Lines of a class that becomes none are counted, and left out.
using io::Classes;

/// The classes of MapTR and those after it: a divider is a laneline and a boundary a roadedge; ped_crossing
/// and centerline are left out.
const Classes& usual_classes();

/// How the results of a network are read. What it refers to must live as long as the reading.
struct ResultsReading {
  const DriveLog& drive;
  LeftOut& left_out;
  const Classes& classes = usual_classes();
  /// Is called for each sample with the share of the file that was read, 0..1.
  std::function<void(double share)> on_step = [](double /*share*/) {};
};

/// Results of a network as detections of one drive.
struct ImportedFrames {
  std::vector<DetectionFrame> frames;           ///< stamps ascend
  std::map<std::string, std::size_t> left_out;  ///< number of lines of unused classes, by class
  std::size_t other_drives = 0;                 ///< number of samples of other drives
};

/// Collects the lines that a network saw in the samples of one drive. A line that is
/// wrong is left out, and so is a frame. Not thread-safe.
class FrameCollector {
 public:
  /// `source` names the network. `T_drive_points` takes the network's points to the frame of points of the
  /// drive.
  FrameCollector(const ResultsReading& reading, std::string source,
                 const Eigen::Isometry3d& T_drive_points = Eigen::Isometry3d::Identity());

  /// Takes a sample of the file: `read` calls begin(), add_line() and end(). What it throws as JsonError
  /// makes that the sample, which is at `place`, is left out. The error passes through if that is strict.
  void add_sample(const std::string& place, const std::function<void()>& read);

  /// Begins the frame of a sample. False: the sample is of another drive, and is counted. Throws JsonError.
  bool begin(const std::string& sample);
  /// Adds line number `number` of the sample. `read` calls add(). Throws JsonError if that is strict.
  void add_line(std::size_t number, const std::function<void()>& read);
  /// The type of a class. Throws JsonError if there is no such class.
  std::optional<MarkingType> type_of(const std::string& class_name) const;
  /// Adds a line to the frame. `points` is [[x, y], …] or [[x, y, z], …]; without z they are on the road.
  /// Throws JsonError.
  void add(const std::string& class_name, double confidence, const nlohmann::json& points);
  /// Ends the frame. A frame that the service would refuse is a JsonError.
  void end();

  /// Calls `walk`, which walks over the samples of `file`. If the file is damaged, the samples before that
  /// are kept. Returns the frames. Throws std::runtime_error naming the file if there are none, or no line
  /// that is right, or it is damaged and that is strict.
  ImportedFrames collect(const std::filesystem::path& file, const std::function<void()>& walk) &&;

 private:
  Point in_body(const nlohmann::json& value) const;

  const DriveLog& drive_;
  LeftOut& left_out_;
  const Classes& classes_;
  Eigen::Isometry3d T_body_points_;
  DetectionFrame frame_;
  ImportedFrames imported_;
  std::set<std::int64_t> stamps_;
  std::size_t wrong_lines_ = 0;
  std::string place_;  ///< of the sample
};

/// The types that the lines of some classes become, each once.
std::vector<MarkingType> types_of(const Classes& classes);

/// The names of the classes, with commas between them.
std::string names_of(const Classes& classes);

/// A number from 0 to 1. Throws JsonError.
double confidence(const nlohmann::json& value);

/// Throws JsonError if the service would refuse a frame because of this line.
void check_line(const Detection& line);

/// Throws std::runtime_error if lines were wrong, and the frames have no other.
void check_lines_are_left(const std::vector<DetectionFrame>& frames, std::size_t wrong_lines);

}  // namespace laneloom::imports
