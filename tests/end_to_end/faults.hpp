#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "participants.hpp"
#include "process.hpp"
#include "service.hpp"

namespace laneloom {

inline bool has_reason(const PublishedMap& map, StateReason reason) {
  return std::find(map.reasons.begin(), map.reasons.end(), reason) != map.reasons.end();
}

/// A message of which nothing arrives.
template <class T>
std::vector<T> lose(const T& /*message*/) {
  return {};
}

/// A service on a road, a planner that hears it, and what goes wrong.
class Faults : public ::testing::Test {
 protected:
  /// A road on which all is well.
  void start(int frame_period_ms = 100, const std::vector<std::string>& more = {}) {
    maps_.forget();
    status_.forget();
    auto words = started_by_;
    for (const auto& word : command(config_, more)) words.push_back(word);
    service_ = std::make_unique<Process>(words);
    road_ = std::make_unique<StraightRoad>(config_, frame_period_ms);
    ASSERT_TRUE(maps_.wait_for(is_good)) << service_->errors();
    maps_.forget();
  }
  /// The planner is told, and the map is still there.
  bool says(MapState state, StateReason reason) {
    return maps_.wait_for([&](const PublishedMap& map) {
      return map.state == state && has_reason(map, reason) && has_lanes(map);
    });
  }
  /// A good map comes from now on.
  bool is_good_again() {
    maps_.forget();
    return maps_.wait_for(is_good);
  }
  /// The fault ends.
  bool recovers() {
    road_->send_frames({});
    road_->send_poses({});
    return is_good_again();
  }
  using CounterValues = std::map<std::string, std::uint64_t>;

  CounterValues counters() {
    CounterValues result;
    // Written once a second: of what happened before this call.
    status_.forget();
    status_.wait_for([&](const ServiceStatus& status) {
      result = {status.counters.begin(), status.counters.end()};
      return true;
    });
    return result;
  }
  /// Beyond what it was `before` the fault: some counters rise while all begins, too.
  bool rises(const std::string& counter, CounterValues before) {
    return status_.wait_for([&](const ServiceStatus& status) {
      const CounterValues now(status.counters.begin(), status.counters.end());
      const auto found = now.find(counter);
      return found != now.end() && found->second > before[counter];
    });
  }
  /// `maps` maps in a row are good.
  bool stays_good(std::size_t maps) {
    maps_.forget();
    if (!maps_.wait_for([&, seen = std::size_t{0}](const PublishedMap&) mutable { return ++seen == maps; })) {
      return false;
    }
    const auto samples = maps_.samples();
    // A busy host is no fault of what is tested.
    const auto good = [](const PublishedMap& map) {
      return is_good(map) || (has_lanes(map) && map.state == MapState::degraded &&
                              map.reasons == std::vector{StateReason::overloaded});
    };
    return std::all_of(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(maps), good);
  }

  const DdsConfig config_ = private_config();
  std::vector<std::string> started_by_;  ///< a program that starts the service; empty: none
  std::unique_ptr<Process> service_;
  Listener<PublishedMap> maps_{config_};
  Listener<ServiceStatus> status_{config_};
  std::unique_ptr<StraightRoad> road_;
};

}  // namespace laneloom
