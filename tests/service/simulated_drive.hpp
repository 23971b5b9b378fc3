#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/service_core.hpp"
#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/stages.hpp"
#include "service/ingestion_queue.hpp"
#include "straight_road.hpp"

namespace laneloom::service {

/// The service on a straight road, in simulated time and without DDS: poses every 10 ms, detections every
/// 100 ms. Executor, queue and core are those of laneloomd. Time passes while a frame is fused, if so wished,
/// and between the ticks.
class SimulatedDrive : private StageObserver {
 public:
  explicit SimulatedDrive(const Config& config = {}, std::int64_t frame_period_ms = 100);

  /// Goes on for so long; maps and statuses are those of this time.
  void run_for(std::int64_t duration_ms);

  /// The state and reasons of each map where they differ from those of the map before.
  std::vector<std::string> states() const;
  /// The state and reasons of the newest map.
  std::string state() const;
  const std::vector<PublishedMap>& maps() const { return maps_; }
  const std::vector<ServiceStatus>& statuses() const { return statuses_; }
  /// The frames that were fused into these maps, in the order of fusion.
  std::vector<FusedFrame> fused() const;
  /// The counter in the newest status; 0 where it was never counted.
  std::uint64_t counter(const std::string& name) const;
  const std::optional<snapshot::Snapshot>& snapshot() const { return snapshot_; }  ///< the newest one

  /// The service is killed, and starts again at once with the newest snapshot.
  void restart();
  service::IngestionQueue& queue() { return queue_; }
  std::int64_t now_ns() const { return now_ns_; }

  Channel<DetectionFrame> send_frames;  ///< what goes wrong on the way; empty: nothing
  Channel<VehiclePose> send_poses;
  std::int64_t fusion_ms = 0;      ///< what fusing one frame takes
  std::int64_t clock_jump_ms = 0;  ///< of the system clock

 private:
  void update_begins() override { now_ns_ += fusion_ms * 1'000'000; }
  void stage_done(Stage /*stage*/) override {}
  void start();
  /// Delivers what came until now.
  void deliver();
  void tick(const core::Tick& tick);

  std::int64_t frame_period_ms_;
  std::int64_t now_ns_ = 1'000'000'000'000;  ///< steady clock
  std::int64_t start_ns_ = now_ns_;
  std::int64_t delivered_ms_ = 0;  ///< since the start
  std::uint64_t next_id_ = 1;
  Config config_;
  bool frame_is_ready_ = false;  ///< since the executor fell asleep
  service::IngestionQueue queue_;
  std::unique_ptr<core::ServiceCore> core_;
  std::vector<PublishedMap> maps_;
  std::vector<ServiceStatus> statuses_;
  std::optional<snapshot::Snapshot> snapshot_;
  std::map<std::string, std::uint64_t> counters_;
};

}  // namespace laneloom::service
