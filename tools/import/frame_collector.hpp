#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "import/drive_log.hpp"
#include "laneloom/types.hpp"

namespace laneloom::imports {

/// Results of a network as detections of one drive.
struct ImportedFrames {
  std::vector<DetectionFrame> frames;           ///< stamps ascend
  std::map<std::string, std::size_t> left_out;  ///< number of lines of unused classes, by class
  std::size_t other_drives = 0;                 ///< number of samples of other drives
};

/// Collects the lines that a network with MapTR's classes saw in the samples of one drive. Not thread-safe.
/// All functions except finish() throw JsonError.
class FrameCollector {
 public:
  /// `source` names the network. `T_drive_points` takes the network's points to the frame of points of
  /// `drive`.
  FrameCollector(const DriveLog& drive, std::string source,
                 const Eigen::Isometry3d& T_drive_points = Eigen::Isometry3d::Identity());

  /// Begins the frame of a sample. False: the sample is of another drive, and is counted.
  bool begin(const std::string& sample);
  /// Adds a line to the frame. `points` is [[x, y], …] or [[x, y, z], …]; without z they are on the road. A
  /// divider is a laneline and a boundary a roadedge; ped_crossing and centerline are counted, and left out.
  void add(const std::string& class_name, double confidence, const nlohmann::json& points);
  /// Ends the frame. A frame that the service would refuse is an error.
  void end();

  /// The frames. Throws std::runtime_error naming the file if there are none.
  ImportedFrames finish(const std::string& file) &&;

 private:
  Point in_body(const nlohmann::json& value) const;

  const DriveLog& drive_;
  Eigen::Isometry3d T_body_points_;
  DetectionFrame frame_;
  ImportedFrames imported_;
  std::set<std::int64_t> stamps_;
};

/// The name of one of the classes. Throws JsonError.
std::string class_name(const nlohmann::json& value);

/// A number from 0 to 1. Throws JsonError.
double confidence(const nlohmann::json& value);

}  // namespace laneloom::imports
