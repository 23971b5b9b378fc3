#include "service/ingestion_queue.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "session/admission.hpp"
#include "session/gate.hpp"

namespace laneloom::service {
namespace {

constexpr std::size_t kMaxSources = 16;

}  // namespace

IngestionQueue::IngestionQueue(const Config& config, std::function<void()> frame_is_ready)
    : config_(config.sync), gate_(config.gate), frame_is_ready_(std::move(frame_is_ready)) {
  for (const auto* name : {"detections_received", "poses_received", "objects_received",
                           "frames_dropped_queue_full", "poses_dropped_queue_full"}) {
    state_.counters.add(name, 0);
  }
}

void IngestionQueue::push(DetectionFrame&& frame, std::int64_t arrival_ns) {
  if (enqueue(std::move(frame), arrival_ns) && frame_is_ready_) frame_is_ready_();
}

void IngestionQueue::push(VehiclePose&& pose, std::int64_t arrival_ns) {
  if (enqueue(std::move(pose), arrival_ns) && frame_is_ready_) frame_is_ready_();
}

bool IngestionQueue::enqueue(DetectionFrame&& frame, std::int64_t arrival_ns) {
  // Checked before the frame is thinned: the defect may be in a detection that would be left out.
  const std::string_view refusal = session::defect(frame, gate_);
  const std::size_t left_out = refusal.empty() ? session::admit(gate_, frame) : 0;
  const std::lock_guard lock(mutex_);
  note_frame(arrival_ns);
  note_source(frame, arrival_ns);
  if (!refusal.empty()) {
    state_.counters.add("detections_refused_" + std::string(refusal));
    return false;
  }
  if (left_out > 0) {
    state_.counters.add("frames_thinned");
    state_.counters.add("detections_left_out", left_out);
  }
  if (frames_.size() >= static_cast<std::size_t>(config_.queue_capacity)) drop_oldest_of_most();
  const bool is_ready = readiness_.note_frame(frame.stamp_ns);
  push(frames_, {std::move(frame), arrival_ns});
  return note_ready(is_ready ? 1 : 0, arrival_ns);
}

bool IngestionQueue::enqueue(VehiclePose&& pose, std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  note_pose(arrival_ns);
  if (poses_.size() >= static_cast<std::size_t>(config_.pose_queue_capacity)) {
    poses_.pop_front();
    state_.counters.add("poses_dropped_queue_full");
  }
  const std::size_t ready = readiness_.note_pose(pose.stamp_ns);
  push(poses_, {std::move(pose), arrival_ns});
  return note_ready(ready, arrival_ns);
}

bool IngestionQueue::note_ready(std::size_t frames, std::int64_t arrival_ns) {
  if (frames == 0 || ready_ns_.size() >= static_cast<std::size_t>(config_.queue_capacity)) return false;
  ready_ns_.insert(ready_ns_.end(), frames, arrival_ns);
  return true;
}

std::vector<std::int64_t> IngestionQueue::take_ready() {
  const std::lock_guard lock(mutex_);
  return std::exchange(ready_ns_, {});
}

void IngestionQueue::push(TrackedObjects&& objects, std::int64_t arrival_ns) {
  const std::string_view refusal = session::defect(objects, gate_);
  const std::lock_guard lock(mutex_);
  count_objects();
  if (!refusal.empty()) {
    state_.counters.add("objects_refused_" + std::string(refusal));
    return;
  }
  if (objects_.size() >= static_cast<std::size_t>(config_.queue_capacity)) {
    objects_.pop_front();
    state_.counters.add("objects_dropped_queue_full");
  }
  push(objects_, {std::move(objects), arrival_ns});
}

void IngestionQueue::drop_oldest_of_most() {
  const auto source_of = [](const Numbered& numbered) -> const std::string& {
    return std::get<DetectionFrame>(numbered.arrival.message).source;
  };
  std::map<std::string_view, std::size_t> counts;
  for (const Numbered& numbered : frames_) ++counts[source_of(numbered)];
  const auto most = std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; });
  frames_.erase(std::ranges::find(frames_, most->first, source_of));
  state_.counters.add("frames_dropped_queue_full");
}

void IngestionQueue::note_source(const DetectionFrame& frame, std::int64_t arrival_ns) {
  auto& sources = state_.sources;
  const auto known = std::find_if(sources.begin(), sources.end(), [&](const SourceStatus& source) {
    return source.session_id == frame.session_id && source.source == frame.source;
  });
  if (known == sources.end()) {
    if (sources.size() == kMaxSources) forget_a_source();
    sources.push_back({frame.source, frame.session_id, frame.sequence, frame.sequence, 1});
    state_.heard_ns.push_back(arrival_ns);
  } else {
    state_.heard_ns[static_cast<std::size_t>(known - sources.begin())] = arrival_ns;
    // The first frame to arrive may have overtaken one that was lost and sent again.
    known->first_sequence = std::min(known->first_sequence, frame.sequence);
    known->last_sequence = std::max(known->last_sequence, frame.sequence);
    ++known->frames;
  }
}

void IngestionQueue::forget_a_source() {
  const auto silent = std::ranges::min_element(state_.heard_ns);
  state_.sources.erase(state_.sources.begin() + (silent - state_.heard_ns.begin()));
  state_.heard_ns.erase(silent);
}

void IngestionQueue::note_frame(std::int64_t arrival_ns) {
  state_.newest_frame_ns = arrival_ns;
  state_.counters.add("detections_received");
  frames_lost_ = lost_frames_.total();
}

void IngestionQueue::note_pose(std::int64_t arrival_ns) {
  state_.newest_pose_ns = arrival_ns;
  state_.counters.add("poses_received");
  poses_lost_ = lost_poses_.total();
}

void IngestionQueue::count_objects() {
  state_.counters.add("objects_received");
  objects_lost_ = lost_objects_.total();
}

void IngestionQueue::refuse_detections(std::string_view reason, std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  note_frame(arrival_ns);
  state_.counters.add("detections_refused_" + std::string(reason));
}

void IngestionQueue::refuse_pose(std::string_view reason, std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  note_pose(arrival_ns);
  state_.counters.add("poses_refused_" + std::string(reason));
}

void IngestionQueue::refuse_objects(std::string_view reason) {
  const std::lock_guard lock(mutex_);
  count_objects();
  state_.counters.add("objects_refused_" + std::string(reason));
}

void IngestionQueue::note_other_service(std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  state_.other_service_ns = arrival_ns;
}

void IngestionQueue::number_detections(const dds::WriterId& writer, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  lost_frames_.note(writer, number);
}

void IngestionQueue::number_pose(const dds::WriterId& writer, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  lost_poses_.note(writer, number);
}

void IngestionQueue::number_objects(const dds::WriterId& writer, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  lost_objects_.note(writer, number);
}

core::Arrivals IngestionQueue::take() {
  core::Arrivals arrivals;
  std::array<Queue, 3> queues;
  {
    const std::lock_guard lock(mutex_);
    arrivals = state_;
    arrivals.counters.add("detections_lost", frames_lost_);
    arrivals.counters.add("poses_lost", poses_lost_);
    arrivals.counters.add("objects_lost", objects_lost_);
    queues = {std::exchange(frames_, {}), std::exchange(poses_, {}), std::exchange(objects_, {})};
  }
  std::vector<Numbered> merged;
  for (Queue& queue : queues) std::ranges::move(queue, std::back_inserter(merged));
  std::ranges::sort(merged, {}, &Numbered::order);
  arrivals.messages.reserve(merged.size());
  for (auto& [order, arrival] : merged) arrivals.messages.push_back(std::move(arrival));
  return arrivals;
}

}  // namespace laneloom::service
