#pragma once

#include <cstdint>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "laneloom/messages.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "view/traffic.hpp"

namespace laneloom::view {

/// One moment of a drive: the map, with the newest messages beside it.
struct ViewMoment {
  PublishedMap map;                          ///< with the markings of the topic road_markings
  bool has_state = true;                     ///< else the map is from a file without states
  bool alive = true;                         ///< the service asserts its liveliness
  bool repeated = false;                     ///< the map was shown before: something else is new
  std::int64_t seen_ns = 0;                  ///< time of the reception of what is new, system clock
  std::optional<DetectionFrame> detections;  ///< the frame that was fused last, seen from the map's pose
  std::optional<VehiclePose> pose;           ///< the newest pose
  std::optional<ServiceStatus> status;       ///< the newest status
  Traffic traffic;                           ///< the other vehicles at the map's stamp
  std::vector<LocalMap> others;              ///< maps of the same time to compare with; always as many
  nlohmann::json why;             ///< reasons of the mapper (why/reason_history.hpp); null: not known
  std::optional<LocalMap> truth;  ///< of the road around; drawn beside the maps
};

/// Makes moments of messages, in the order of their arrival. A map and its markings come one after the other.
/// The moment is complete with both, or with the next map if the markings were lost. Not thread-safe.
class MomentBuilder {
 public:
  /// Each takes a message that arrived at `now_ns` (system clock), and returns whether take() has a moment.
  bool add(DetectionFrame&& frame, std::int64_t now_ns);
  bool add(VehiclePose&& pose, std::int64_t now_ns);
  bool add(PublishedMap&& map, std::int64_t now_ns);
  bool add(RoadMarkings&& markings, std::int64_t now_ns);
  bool add(ServiceStatus&& status, std::int64_t now_ns);
  bool add(TrackedObjects&& objects, std::int64_t now_ns);
  /// The map's way shows what became of the turn.
  bool add(NextTurn&& /*turn*/, std::int64_t /*now_ns*/) { return false; }

  /// The moment that was completed. Is to be called once each time that add() returns true.
  ViewMoment take();
  /// The moment of the map that still waits for its markings. None: no map waits.
  std::optional<ViewMoment> finish();

 private:
  /// A map and the time of its reception.
  using Waiting = std::pair<PublishedMap, std::int64_t>;

  ViewMoment moment_of(Waiting&& waiting);

  std::optional<Waiting> waiting_, complete_;
  std::deque<DetectionFrame> frames_;  ///< the newest
  std::optional<VehiclePose> pose_;
  std::optional<ServiceStatus> status_;
  TrafficFollower traffic_;
};

}  // namespace laneloom::view
