#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/objects.hpp"
#include "mapping/trails/trails.hpp"
#include "session/pending_messages.hpp"
#include "session/pose_buffer.hpp"

namespace laneloom::view {

/// A tracker's message with the vehicle's pose at its stamp.
struct SeenObjects {
  TrackedObjects objects;
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
};

/// The other vehicles at one moment.
struct Traffic {
  std::vector<SeenObjects> seen;      ///< the newest message of each tracker that was heard within a second
  std::vector<trails::Trail> trails;  ///< as the mapper has them
};

/// Follows other vehicles by the rules of the mapper and its session. Not thread-safe.
class TrafficFollower {
 public:
  TrafficFollower();

  /// A pose that is not newer than the one before is left out, unless it is of another session: then
  /// everything is forgotten.
  void add(const VehiclePose& pose);
  /// Objects that have a defect, or that came in a wrong order, are left out.
  void add(TrackedObjects objects);
  /// The traffic at a stamp, around the vehicle.
  Traffic at(std::int64_t stamp_ns, const Point& vehicle);

 private:
  void forget();

  Config config_;
  std::optional<VehiclePose> newest_pose_;
  session::PoseBuffer poses_;
  session::PendingMessages<TrackedObjects> pending_;
  trails::Trails trails_;
  std::map<std::uint64_t, SeenObjects> seen_;  ///< by session
};

}  // namespace laneloom::view
