#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/state_names.hpp"
#include "participants.hpp"
#include "process.hpp"
#include "service.hpp"

namespace laneloom {

inline bool has_reason(const PublishedMap& map, StateReason reason) {
  return std::find(map.reasons.begin(), map.reasons.end(), reason) != map.reasons.end();
}

/// A host that stops the senders or the service for a while is no fault of what is tested.
inline bool busy_host_explains(const PublishedMap& map) {
  // After a stop of the service, its inputs are fresh again before a frame is fused; refused frames go on.
  const bool nothing_fused_yet =
      map.state == MapState::stale && map.reasons == std::vector{StateReason::unsynchronised};
  return has_lanes(map) &&
         (nothing_fused_yet || std::all_of(map.reasons.begin(), map.reasons.end(), [](StateReason reason) {
            return reason == StateReason::overloaded || reason == StateReason::no_detections ||
                   reason == StateReason::no_poses;
          }));
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
  /// So many good maps in a row come from now on.
  bool is_good_again(std::size_t maps = 1) {
    maps_.forget();
    const auto in_a_row = [maps, good = std::size_t{0}](const PublishedMap& map) mutable {
      good = is_good(map) ? good + 1 : 0;
      return good == maps;
    };
    return maps_.wait_for(in_a_row, kPatience);
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
  /// `maps` maps in a row are good, and none before them is bad.
  ::testing::AssertionResult stays_good(std::size_t maps) {
    maps_.forget();
    std::size_t in_a_row = 0;
    std::string bad;
    const auto decided = [&](const PublishedMap& map) {
      in_a_row = is_good(map) ? in_a_row + 1 : 0;
      if (!is_good(map) && !busy_host_explains(map)) bad = state_text(map.state, map.reasons);
      return in_a_row == maps || !bad.empty();
    };
    maps_.wait_for(decided, kPatience);
    if (bad.empty() && in_a_row == maps) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << (bad.empty() ? "not good for long" : bad) << "\n"
                                         << service_->errors();
  }

  /// A busy host breaks a row of maps again and again.
  static constexpr std::chrono::seconds kPatience{90};
  const DdsConfig config_ = private_config();
  std::vector<std::string> started_by_;  ///< a program that starts the service; empty: none
  std::unique_ptr<Process> service_;
  Listener<PublishedMap> maps_{config_};
  Listener<ServiceStatus> status_{config_};
  std::unique_ptr<StraightRoad> road_;
};

}  // namespace laneloom
