#include "view/events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "io/printable.hpp"
#include "laneloom/state_names.hpp"
#include "status/report.hpp"

namespace laneloom::view {
namespace {

/// Parts of the names of counters that should not rise.
constexpr std::array kUnwanted{"refused", "dropped", "lost",     "missed",   "failed",
                               "resets",  "thinned", "left_out", "restarted"};

bool is_unwanted(const std::string& counter) {
  return std::any_of(kUnwanted.begin(), kUnwanted.end(),
                     [&](const char* part) { return counter.find(part) != std::string::npos; });
}

void add_rises(const ServiceStatus& status, const ServiceStatus& before, std::vector<ViewEvent>& events) {
  if (status.session_id != before.session_id || status.sequence == before.sequence) return;
  for (const auto& [counter, rise] : status::rises(status, before))
    if (is_unwanted(counter))
      events.push_back({"counter", fmt::format("{} +{}", io::printable(counter), rise)});
}

}  // namespace

std::vector<ViewEvent> EventFinder::next(const ViewMoment& moment) {
  const PublishedMap& map = moment.map;
  const auto before = std::exchange(before_, Seen{.alive = moment.alive,
                                                  .session_id = map.session_id,
                                                  .map_id = map.map_id,
                                                  .state = state_text(map.state, map.reasons),
                                                  .status = moment.status});
  std::vector<ViewEvent> events;
  if (!before || !moment.has_state) return events;
  if (moment.alive != before->alive)
    events.push_back({"service", moment.alive ? "the service is alive" : "the service is gone or hangs"});
  if (map.session_id != before->session_id)
    events.push_back({"service", fmt::format("another session of the service: {}", map.session_id)});
  if (map.map_id != before->map_id) events.push_back({"reset", "a new map: earlier ids are void"});
  if (before_->state != before->state)
    events.push_back({"state", fmt::format("{} → {}", before->state, before_->state)});
  if (moment.status && before->status) add_rises(*moment.status, *before->status, events);
  return events;
}

}  // namespace laneloom::view
