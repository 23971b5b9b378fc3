#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "view/moment.hpp"
#include "view/quality.hpp"

namespace laneloom::view {

/// Something that happened between two moments.
struct ViewEvent {
  std::string kind;  ///< state, service, reset, counter; of the map: own_lane, way, stopline
  std::string text;  ///< for people
};

/// Finds events from moment to moment. Not thread-safe.
class EventFinder {
 public:
  /// The events since the moment before; none at the first moment. `quality` is that of the moment's map;
  /// null: the map is repeated. The events that a driver cares for come first.
  std::vector<ViewEvent> next(const ViewMoment& moment, const MapQuality* quality);

 private:
  void add_driving(const ViewMoment& moment, const MapQuality& quality, std::vector<ViewEvent>& events);

  /// The parts by which moments are compared.
  struct Seen {
    bool alive = true;
    std::uint64_t session_id = 0, map_id = 0;
    std::string state;
    std::optional<ServiceStatus> status;
  };

  std::optional<Seen> before_;
  ElementId own_lane_ = kNoElement;  ///< the last one
  bool has_own_lane_ = false;
  std::int64_t lost_ns_ = 0;  ///< when the own lane was lost
};

}  // namespace laneloom::view
