#include "view/events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/seconds.hpp"
#include "io/printable.hpp"
#include "laneloom/state_names.hpp"
#include "status/report.hpp"

namespace laneloom::view {
namespace {

/// Parts of the names of counters that should not rise.
constexpr std::array kUnwanted{"refused", "dropped", "lost",     "missed",   "failed",
                               "resets",  "thinned", "left_out", "restarted"};

/// The jump of a way that passengers feel.
constexpr double kJump_m = 0.3;

/// The counter as words: without underscores.
std::string in_words(const std::string& counter) {
  std::string words = io::printable(counter);
  std::ranges::replace(words, '_', ' ');
  return words;
}

bool is_unwanted(const std::string& counter) {
  return std::any_of(kUnwanted.begin(), kUnwanted.end(),
                     [&](const char* part) { return counter.find(part) != std::string::npos; });
}

void add_rises(const ServiceStatus& status, const ServiceStatus& before, std::vector<ViewEvent>& events) {
  if (status.session_id != before.session_id || status.sequence == before.sequence) return;
  for (const auto& [counter, rise] : status::rises(status, before))
    if (is_unwanted(counter)) events.push_back({"counter", fmt::format("{} +{}", in_words(counter), rise)});
}

}  // namespace

/// Adds what a driver would notice.
void EventFinder::add_driving(const ViewMoment& moment, const MapQuality& quality,
                              std::vector<ViewEvent>& events) {
  const bool had = std::exchange(has_own_lane_, quality.own_lane != kNoElement);
  const ElementId last = own_lane_;
  if (has_own_lane_) own_lane_ = quality.own_lane;
  if (had && !has_own_lane_) {
    lost_ns_ = moment.seen_ns;
    events.push_back({"own_lane", fmt::format("own lane {} is lost", last)});
  } else if (!had && has_own_lane_ && last != kNoElement) {
    events.push_back({"own_lane", fmt::format("own lane {} after {:.1f} s without", own_lane_,
                                              seconds(moment.seen_ns - lost_ns_))});
  } else if (quality.own_changed && last != own_lane_) {
    events.push_back({"own_lane", fmt::format("own lane {} is now {}", last, own_lane_)});
  }
  if (quality.jump_m.value_or(0.0) >= kJump_m)
    events.push_back({"way", fmt::format("the way jumps {:.2f} m, 10 m ahead", *quality.jump_m)});
  for (const LineageEvent& event : moment.map.map.lineage)
    if (event.element == LineageEvent::Element::stopline && event.kind == LineageEvent::Kind::born)
      events.push_back({"stopline", fmt::format("stop line {} appears", event.id)});
}

std::vector<ViewEvent> EventFinder::next(const ViewMoment& moment, const MapQuality* quality) {
  const PublishedMap& map = moment.map;
  const auto before = std::exchange(before_, Seen{.alive = moment.alive,
                                                  .session_id = map.session_id,
                                                  .map_id = map.map_id,
                                                  .state = state_text(map.state, map.reasons),
                                                  .status = moment.status});
  std::vector<ViewEvent> events;
  if (quality != nullptr) add_driving(moment, *quality, events);
  if (!before) return {};
  if (!moment.has_state) return events;
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
