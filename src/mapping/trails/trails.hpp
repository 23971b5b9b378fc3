#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

/// The ways that other vehicles drove. Ours.
namespace laneloom::trails {

/// The way that one vehicle drove while it was followed without a jump.
struct Trail {
  std::uint64_t session = 0, object = 0;  ///< name the vehicle; a later trail may have the same names
  Polyline points;                        ///< map frame, as they were driven, 1 m apart at least, at most 64
  bool told_side = false;                 ///< the trail has told on which side traffic keeps
  // The newest observation.
  std::int64_t stamp_ns = 0;
  Point position = Point::Zero();                      ///< map frame
  Eigen::Vector2d heading = Eigen::Vector2d::UnitX();  ///< map frame, unit length
  double speed_mps = 0.0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(session, object, points, told_side, stamp_ns, position, heading, speed_mps);
  }
};

/// From the vehicle, in metres. A tracker's positions further away err by more than half a lane.
inline constexpr double kTrackerReach_m = 60.0;

/// Two points of a trail that are further apart do not follow one another.
inline constexpr double kMaxGap_m = 10.0;

/// The direction of a trail at one of its two points or more, of unit length. A chord over three steps is
/// surer than one step, beside which a tracker's noise is large.
Eigen::Vector2d direction_at(const Polyline& points, std::size_t k);

/// Follows the vehicles, or the cyclists, that a tracker tells of. A vehicle leaves a trail where it drives
/// forwards. A vehicle that stands, reverses, or whose heading is not known leaves none, and neither do
/// pedestrians.
///
/// Messages of one session must come in the order of their stamps. Where several come together, they come in
/// the order of their stamps, and of their sessions. The order of objects within a message does not matter.
class Trails {
 public:
  enum class Of : std::uint8_t { vehicles, cyclists };
  Trails() = default;
  explicit Trails(Of followed) : followed_(followed) {}

  /// Takes the objects of one message, in the body frame, at the vehicle's pose at their stamp.
  void add(const TrackedObjects& objects, const Eigen::Isometry3d& T_map_body);
  /// Forgets what lies further from the vehicle than it will be of use.
  void keep_around(const Point& vehicle);

  /// Whether a vehicle has left a trail since this was asked last.
  bool take_growth() { return std::exchange(grown_, false); }

  const std::vector<Trail>& all() const { return trails_; }  ///< as they began
  std::vector<Trail>& all() { return trails_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(trails_, grown_);
  }

 private:
  Trail* trail_of(const Trail& observed);
  void drop_excess(std::int64_t now_ns);

  Of followed_ = Of::vehicles;
  std::vector<Trail> trails_;
  bool grown_ = false;
};

}  // namespace laneloom::trails
