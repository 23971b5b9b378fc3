#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "core/arrivals.hpp"
#include "core/readiness.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "service/lost_messages.hpp"

namespace laneloom::service {

/// The queue between the threads of DDS, which push, and the executor, which takes. It is bounded: for a new
/// pose the oldest pose is dropped, for new objects the oldest objects, for a new frame the oldest frame of
/// the source that has the most. All are counted. All functions are thread-safe.
class IngestionQueue {
 public:
  /// `frame_is_ready` is called, in the thread of the message that made it so, when a frame can be fused: it
  /// and a pose as new as its stamp have come. It may be empty.
  explicit IngestionQueue(const Config& config, std::function<void()> frame_is_ready = {});

  /// Refuses a frame that has a defect() as a whole. Other frames are reduced by admit(), so that memory is
  /// bounded too.
  void push(DetectionFrame&& frame, std::int64_t arrival_ns);
  void push(VehiclePose&& pose, std::int64_t arrival_ns);
  void push(TrackedObjects&& objects, std::int64_t arrival_ns);
  /// Counts a message that was refused as invalid. It has arrived all the same.
  void refuse_detections(std::string_view reason, std::int64_t arrival_ns);
  void refuse_pose(std::string_view reason, std::int64_t arrival_ns);
  void refuse_objects(std::string_view reason);

  /// Notes that another service of the same vehicle was heard.
  void note_other_service(std::int64_t arrival_ns);
  /// Is called before each push or refusal, with the writer of the message and its number among the writer's
  /// messages. The numbers tell which messages never came.
  void number_detections(const dds::WriterId& writer, std::uint64_t number);
  void number_pose(const dds::WriterId& writer, std::uint64_t number);
  void number_objects(const dds::WriterId& writer, std::uint64_t number);

  /// Takes the messages since the call before, with the counters since the start.
  core::Arrivals take();
  /// Takes the times at which frames became ready since the call before.
  std::vector<std::int64_t> take_ready();

 private:
  /// A queued message.
  struct Numbered {
    std::uint64_t order = 0;  ///< its place in the order of arrival
    core::Arrival arrival;
  };
  using Queue = std::deque<Numbered>;

  void push(Queue& queue, core::Arrival&& arrival) { queue.push_back({next_order_++, std::move(arrival)}); }
  /// Queues a message. Returns whether it made a frame ready.
  bool enqueue(DetectionFrame&& frame, std::int64_t arrival_ns);
  bool enqueue(VehiclePose&& pose, std::int64_t arrival_ns);
  bool note_ready(std::size_t frames, std::int64_t arrival_ns);
  void drop_oldest_of_most();
  void note_source(const DetectionFrame& frame, std::int64_t arrival_ns);
  /// Forgets the one that has been silent for the longest time.
  void forget_a_source();
  void note_frame(std::int64_t arrival_ns);
  void note_pose(std::int64_t arrival_ns);
  void count_objects();

  SyncConfig config_;
  GateConfig gate_;
  std::function<void()> frame_is_ready_;
  std::mutex mutex_;
  std::uint64_t next_order_ = 0;
  Queue frames_;
  Queue poses_;
  Queue objects_;
  core::Readiness readiness_;
  std::vector<std::int64_t> ready_ns_;
  LostMessages lost_frames_;
  LostMessages lost_poses_;
  LostMessages lost_objects_;
  // Lost messages are counted together with the message that shows the loss, so that the sums are right at
  // every instant.
  std::uint64_t frames_lost_ = 0;
  std::uint64_t poses_lost_ = 0;
  std::uint64_t objects_lost_ = 0;
  core::Arrivals state_;  ///< without messages, which are in the queues
};

}  // namespace laneloom::service
