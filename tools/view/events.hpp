#pragma once

#include <optional>
#include <string>
#include <vector>

#include "view/moment.hpp"

namespace laneloom::view {

/// Something that happened between two moments.
struct ViewEvent {
  std::string kind;  ///< state, service, reset, or counter
  std::string text;  ///< for people
};

/// Finds events from moment to moment. Not thread-safe.
class EventFinder {
 public:
  /// The events since the moment before; none at the first moment.
  std::vector<ViewEvent> next(const ViewMoment& moment);

 private:
  /// The parts by which moments are compared.
  struct Seen {
    bool alive = true;
    std::uint64_t session_id = 0, map_id = 0;
    std::string state;
    std::optional<ServiceStatus> status;
  };

  std::optional<Seen> before_;
};

}  // namespace laneloom::view
