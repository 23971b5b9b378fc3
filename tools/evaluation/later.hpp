#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/distribution.hpp"
#include "laneloom/types.hpp"

/// The quality of single detections and maps, told without truth: by later detections from close by.
///
/// A place ahead is on the way that the vehicle drove afterwards, where a later frame has it 6 to 10 m ahead.
/// Lines are told by where they cross the road there, as their lateral offset from the vehicle's way.
/// - Seen later: the points of later detections that lay 6 to 10 m ahead of the vehicle, and lie within 2 m
///   along the road of the place. At least six of them, without a gap of 0.6 m, on less than 1 m, are a line;
///   its offset is their median.
/// - Recall: of the lines seen later, the share for which there is a line of the same type within 0.5 m.
/// - Precision: of the lines, the share within 0.5 m of which at least two points are seen later. A line that
///   is further to a side than anything was seen from close by, over the 28 m ahead, is not asked: a camera
///   may never see it again.
/// - Lateral errors: of the lines seen later that both a single detection and a map line find, the offset of
///   the nearest one. These are pairs: both are asked of the same places.
/// - Own lane: a lane whose sides run left and right of the vehicle's way, 8 m ahead. Its id changes where it
///   is another one than the last, also where the vehicle itself changes lanes.
///
/// The vehicle's poses are taken to be exact over the 40 m that matter: what they drift adds to all errors.
namespace laneloom::evaluation {

inline constexpr std::array kLaterDistances_m{12.0, 20.0, 28.0};
inline constexpr std::array kLaterTypes{MarkingType::laneline, MarkingType::roadedge};

/// The score of lines of one type, at one distance ahead, over all frames.
struct LaterScore {
  struct Subject {
    std::size_t lines = 0;
    std::size_t right = 0;            ///< number of right lines
    std::size_t found = 0;            ///< number of lines seen later that it found
    Distribution lateral_errors_m{};  ///< absolute, of the pairs
  };
  /// The figures of a subject. None: the value cannot be told.
  struct Figures {
    std::optional<double> precision, recall;  ///< 0..1
    std::optional<double> rms_m, p95_m;       ///< of the pairs' lateral errors
  };
  std::size_t seen_later = 0;  ///< number of lines seen later
  Subject single, map;

  Figures figures(const Subject& subject) const;  ///< of `single` or `map`
};

/// The steadiness of the lane that the vehicle is in.
struct OwnLaneScore {
  std::size_t frames = 0;  ///< number of frames with an own lane
  std::size_t id_changes = 0;
  Distribution widths_m;
};

/// Rates a drive frame by frame, as soon as the places ahead of a frame have been driven past. It remembers
/// no more than these. Not thread-safe.
class LaterMeter {
 public:
  /// Single detections of less confidence do not count.
  explicit LaterMeter(double min_confidence) : min_confidence_(min_confidence) {}

  /// Adds the next frame and the map after it, in the order of stamps. The first two seconds, in which the
  /// map is built, are left out, and so are frames less than 0.5 m after the one before. A step of 10 m or
  /// more begins a new drive.
  void add(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, const LocalMap& map);

  const LaterScore& score(MarkingType type, std::size_t distance) const {
    return scores_[distance][index(type)];
  }
  /// The scores of the frames that were rated since the last call, over all types and distances. The meter
  /// forgets these scores, so that it can run forever.
  LaterScore take_scores();
  /// The stamp of the frame that was rated last; 0: none was.
  std::int64_t rated_ns() const { return rated_ns_; }
  /// Whether any line was seen later, so that there are figures.
  bool any() const;
  const OwnLaneScore& own_lane() const { return own_lane_; }
  std::size_t frames() const { return frames_; }  ///< number of frames that were rated
  std::size_t lanes() const { return lanes_; }    ///< number of lanes in all of their maps
  double driven_m() const { return driven_m_; }   ///< between the frames that were rated

 private:
  using LinesByType = std::array<std::vector<Polyline>, kMarkingTypeCount>;
  /// The outermost offsets at which points were seen. At first there is none.
  struct Sides {
    double right_m = std::numeric_limits<double>::infinity();
    double left_m = -std::numeric_limits<double>::infinity();
  };
  struct Moment {
    std::int64_t stamp_ns = 0;
    Eigen::Isometry3d T_map_body;
    double driven_m = 0.0;                           ///< since the drive began
    LinesByType single, map;                         ///< map frame
    std::array<Polyline, kMarkingTypeCount> nearby;  ///< points that lay close ahead, map frame
    Sides sides;                                     ///< of these points
    std::vector<Lane> lanes;
  };
  void add_detections(const DetectionFrame& frame, Moment& moment) const;
  Eigen::Isometry3d pose_ahead(double distance_m) const;
  std::vector<double> seen_later(MarkingType type, double distance_m,
                                 const Eigen::Isometry3d& T_there_map) const;
  bool looked_at(double distance_m) const;
  Sides sides_seen() const;
  void rate_first();
  void rate_lines(std::size_t distance, const Sides& sides);
  void rate_own_lane();

  double min_confidence_;
  std::int64_t begin_ns_ = 0;  ///< of the drive
  std::int64_t rated_ns_ = 0;
  std::deque<Moment> moments_;
  std::array<std::array<LaterScore, kMarkingTypeCount>, kLaterDistances_m.size()> scores_;
  OwnLaneScore own_lane_;
  ElementId last_own_lane_ = kNoElement;
  std::size_t frames_ = 0, lanes_ = 0;
  double driven_m_ = 0.0;
};

/// Throws std::runtime_error, whose text begins with `name`, if a drive was too short, or shows too little,
/// to be rated.
void require_rated(const LaterMeter& meter, const std::string& name);

}  // namespace laneloom::evaluation
