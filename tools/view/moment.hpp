#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "laneloom/messages.hpp"

namespace laneloom {

/// All that is known of one moment of a drive.
struct ViewMoment {
  PublishedMap map;                          ///< with the markings of the topic road_markings
  bool has_state = true;                     ///< else the map is of a file that tells of none
  bool alive = true;                         ///< the service asserts its liveliness
  std::int64_t seen_ns = 0;                  ///< when the map was received, system clock
  std::optional<DetectionFrame> detections;  ///< the frame that was fused last, seen from the map's pose
  std::optional<VehiclePose> pose;           ///< the newest
  std::optional<ServiceStatus> status;       ///< the newest
  std::vector<LocalMap> others;              ///< of the same time, to compare with; always as many
};

/// Puts moments together from messages, in the order of their arrival. A map and its markings come one after
/// the other: the moment is complete with both, or with the next map where the markings were lost. Not
/// thread-safe.
class MomentBuilder {
 public:
  /// Each takes a message that arrived at `now_ns` (system clock), and tells whether take() has a moment.
  bool add(DetectionFrame&& frame, std::int64_t now_ns);
  bool add(VehiclePose&& pose, std::int64_t now_ns);
  bool add(PublishedMap&& map, std::int64_t now_ns);
  bool add(RoadMarkings&& markings, std::int64_t now_ns);
  bool add(ServiceStatus&& status, std::int64_t now_ns);

  /// The moment that was completed; to be called once for each true.
  ViewMoment take();
  /// The map that still waits for its markings.
  std::optional<ViewMoment> finish();

 private:
  /// A map and when it was received.
  using Waiting = std::pair<PublishedMap, std::int64_t>;

  ViewMoment moment_of(Waiting&& waiting);

  std::optional<Waiting> waiting_, complete_;
  std::deque<DetectionFrame> frames_;  ///< the newest
  std::optional<VehiclePose> pose_;
  std::optional<ServiceStatus> status_;
};

}  // namespace laneloom
