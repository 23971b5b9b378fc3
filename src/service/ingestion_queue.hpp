#pragma once

#include <array>
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

/// The topics that the service reads.
enum class Input : std::uint8_t { detections, poses, objects, next_turns };
inline constexpr std::array kInputNames{"detections", "poses", "objects", "next_turns"};

/// The queue between the threads of DDS, which push, and the executor, which takes. It is bounded: for a new
/// message of a full topic its oldest one is dropped; of detections, the oldest frame of the source that has
/// the most. All are counted. All functions are thread-safe.
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
  void push(NextTurn&& turn, std::int64_t arrival_ns);
  /// Counts a message that was refused as invalid. It has arrived all the same.
  void refuse(Input input, std::string_view reason, std::int64_t arrival_ns);

  /// Notes that another service of the same vehicle was heard.
  void note_other_service(std::int64_t arrival_ns);
  /// Is called before each push or refusal, with the writer of the message and its number among the writer's
  /// messages. The numbers tell which messages never came.
  void number(Input input, const dds::WriterId& writer, std::uint64_t number);

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
  /// What came over one topic.
  struct Stream {
    Queue queue;
    LostMessages lost;
    /// Lost messages are counted together with the message that shows the loss, so that the sums are right at
    /// every instant.
    std::uint64_t lost_count = 0;
  };

  Stream& stream(Input input) { return streams_.at(static_cast<std::size_t>(input)); }
  Queue& queue(Input input) { return stream(input).queue; }
  void push(Queue& queue, core::Arrival&& arrival) { queue.push_back({next_order_++, std::move(arrival)}); }
  /// Queues a message that the map can do without.
  template <class T>
  void push_optional(Input input, T&& message, std::int64_t arrival_ns);
  /// Queues a message. Returns whether it made a frame ready.
  bool enqueue(DetectionFrame&& frame, std::int64_t arrival_ns);
  bool enqueue(VehiclePose&& pose, std::int64_t arrival_ns);
  bool note_ready(std::size_t frames, std::int64_t arrival_ns);
  void drop_oldest_of_most();
  void note_source(const DetectionFrame& frame, std::int64_t arrival_ns);
  /// Forgets the one that has been silent for the longest time.
  void forget_a_source();
  /// Counts a message that arrived.
  void note(Input input, std::int64_t arrival_ns);

  SyncConfig config_;
  GateConfig gate_;
  std::function<void()> frame_is_ready_;
  std::mutex mutex_;
  std::uint64_t next_order_ = 0;
  std::array<Stream, kInputNames.size()> streams_;
  core::Readiness readiness_;
  std::vector<std::int64_t> ready_ns_;
  core::Arrivals state_;  ///< without messages, which are in the queues
};

}  // namespace laneloom::service
