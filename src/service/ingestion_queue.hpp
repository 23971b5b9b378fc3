#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/counters.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/types.hpp"
#include "service/lost_messages.hpp"

namespace laneloom {

/// A message and when it came, by the steady clock.
struct Arrival {
  std::variant<VehiclePose, DetectionFrame> message;
  std::int64_t arrival_ns = 0;
};

/// Between the threads of DDS, which push, and the executor, which drains. Bounded: for a new pose the oldest
/// is dropped, for a new frame the oldest of the source that has the most; both are counted. All functions
/// are thread-safe.
class IngestionQueue {
 public:
  explicit IngestionQueue(const Config& config);

  /// Refuses a frame that has a defect() whole. Keeps of any other what admit() leaves, so that memory is
  /// bounded too.
  void push(DetectionFrame&& frame, std::int64_t arrival_ns);
  void push(VehiclePose&& pose, std::int64_t arrival_ns);
  /// A message came that was no valid one.
  void refuse_detections(std::string_view reason);
  void refuse_pose(std::string_view reason);

  /// Another service of the same vehicle was heard.
  void note_other_service(std::int64_t arrival_ns);
  /// Before each of these: its writer, and its number among that writer's. Tells what never came.
  void number_detections(const dds::WriterId& writer, std::uint64_t number);
  void number_pose(const dds::WriterId& writer, std::uint64_t number);

  /// All messages, in the order of their arrival.
  std::vector<Arrival> drain();

  /// Taken at one instant: detections_received = refused + dropped + drained + queued, and likewise of poses.
  struct Snapshot {
    Counters counters;
    std::size_t queued_frames = 0;
    std::optional<std::int64_t> newest_frame_ns;  ///< arrival
    std::optional<std::int64_t> newest_pose_ns;
    std::optional<std::int64_t> other_service_ns;
    std::vector<SourceStatus> sources;  ///< the newest sessions, in the order of their beginning
  };
  Snapshot snapshot() const;

 private:
  struct Numbered {
    std::uint64_t order = 0;
    Arrival arrival;
  };
  using Queue = std::deque<Numbered>;

  void push(Queue& queue, Arrival&& arrival) { queue.push_back({next_order_++, std::move(arrival)}); }
  void drop_oldest_of_most();
  void note_source(const DetectionFrame& frame);
  void count_frame();
  void count_pose();

  SyncConfig config_;
  GateConfig gate_;
  mutable std::mutex mutex_;
  std::uint64_t next_order_ = 0;
  Queue frames_;
  Queue poses_;
  LostMessages lost_frames_;
  LostMessages lost_poses_;
  // What was lost is taken over with the message that shows it, so that the sums are right at every instant.
  std::uint64_t frames_lost_ = 0;
  std::uint64_t poses_lost_ = 0;
  Snapshot state_;
};

}  // namespace laneloom
