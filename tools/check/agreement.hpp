#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "check/correction.hpp"
#include "check/drive.hpp"
#include "laneloom/types.hpp"

namespace laneloom::check {

/// How well the frames of a drive agree with one another, if a correction is applied to the drive.
///
/// Roads stand still: what a frame saw lies, by the poses, where a frame a few metres before or after it saw
/// it. Each pair of such frames gives a disagreement from 0 to 1: the mean distance of the points of one from
/// the lines of the other, in metres, of which each counts up to 1 m. Only points that lie within the other
/// frame's view count. Where there are too few of these, the disagreement is 1.
class Agreement {
 public:
  /// `frames` are of one source. `pose_scale` is in metres per unit of the positions. `poses` must live as
  /// long.
  Agreement(const std::vector<DetectionFrame>& frames, const PoseTrack& poses, double pose_scale);

  /// Whether the vehicle drives far enough, and enough is seen, to tell anything.
  bool can_tell() const { return pairs_.size() >= kFewestPairs; }
  /// The disagreement of each pair of frames, always of the same pairs.
  std::vector<double> disagreements(const Correction& correction) const;
  /// Whether a correction makes sense at all.
  bool plausible(const Correction& correction) const {
    return drives_forward(correction) && lines_lie_well(correction);
  }
  /// Whether the vehicle is upright, and its nose is where it drives to.
  bool drives_forward(const Correction& correction) const;
  /// Whether lines lie around the vehicle, level and mostly along its way.
  bool lines_lie_well(const Correction& correction) const;
  /// The angle that the vehicle turns by, in all.
  double turned_deg() const { return turned_deg_; }
  /// How far lines are from the origin of their frame, in their unit: between the nearest and the farthest.
  double size() const;

 private:
  static constexpr std::size_t kFewestPairs = 12;
  struct View {
    std::int64_t stamp_ns = 0;
    std::vector<Detection> lines;  ///< with points at short distances
  };
  struct Line {
    Polyline points;
    Eigen::AlignedBox2d bounds;
  };
  /// A view in the body frame.
  struct Outline {
    Eigen::Isometry3d T_map_body;
    std::array<std::vector<Line>, 2> lines;  ///< along the road, and stop lines
    Eigen::AlignedBox2d bounds;
  };
  using Pair = std::pair<std::size_t, std::size_t>;  ///< places in `views_`

  static std::optional<double> distance(const Eigen::Vector2d& point, const std::vector<Line>& lines);
  std::optional<Outline> outline(const View& view, const Correction& correction) const;
  static double disagreement(const Outline& from, const Outline& to);

  const PoseTrack& poses_;
  std::vector<View> views_;
  std::vector<Pair> pairs_;
  double turned_deg_ = 0.0;
};

}  // namespace laneloom::check
