#include "service/ingestion_queue.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace laneloom {
namespace {

constexpr std::size_t kMaxSources = 16;

}  // namespace

IngestionQueue::IngestionQueue(const SyncConfig& config) : config_(config) {
  for (const auto* name : {"detections_received", "detections_lost", "poses_received", "poses_lost",
                           "frames_dropped_queue_full", "poses_dropped_queue_full"}) {
    state_.counters.add(name, 0);
  }
}

void IngestionQueue::push(DetectionFrame&& frame, std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  count_frame();
  state_.newest_frame_ns = arrival_ns;
  note_source(frame);
  push(frames_, config_.queue_capacity, {std::move(frame), arrival_ns}, "frames_dropped_queue_full");
}

void IngestionQueue::push(VehiclePose&& pose, std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  count_pose();
  state_.newest_pose_ns = arrival_ns;
  push(poses_, config_.pose_queue_capacity, {std::move(pose), arrival_ns}, "poses_dropped_queue_full");
}

void IngestionQueue::push(Queue& queue, int capacity, Arrival&& arrival, std::string_view dropped) {
  if (queue.size() >= static_cast<std::size_t>(capacity)) {
    queue.pop_front();
    state_.counters.add(dropped);
  }
  queue.push_back({next_order_++, std::move(arrival)});
}

void IngestionQueue::note_source(const DetectionFrame& frame) {
  auto& sources = state_.sources;
  const auto known = std::find_if(sources.begin(), sources.end(), [&](const SourceStatus& source) {
    return source.session_id == frame.session_id && source.source == frame.source;
  });
  if (known == sources.end()) {
    if (sources.size() == kMaxSources) sources.erase(sources.begin());
    sources.push_back({frame.source, frame.session_id, frame.sequence, frame.sequence, 1});
  } else {
    known->last_sequence = std::max(known->last_sequence, frame.sequence);
    ++known->frames;
  }
}

void IngestionQueue::count_frame() {
  state_.counters.add("detections_received");
  state_.counters.add("detections_lost", std::exchange(frames_missing_, 0));
}

void IngestionQueue::count_pose() {
  state_.counters.add("poses_received");
  state_.counters.add("poses_lost", std::exchange(poses_missing_, 0));
}

void IngestionQueue::refuse_detections(std::string_view reason) {
  const std::lock_guard lock(mutex_);
  count_frame();
  state_.counters.add("detections_refused_" + std::string(reason));
}

void IngestionQueue::refuse_pose(std::string_view reason) {
  const std::lock_guard lock(mutex_);
  count_pose();
  state_.counters.add("poses_refused_" + std::string(reason));
}

void IngestionQueue::note_other_service(std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  state_.other_service_ns = arrival_ns;
}

void IngestionQueue::number_detections(const dds::WriterId& writer, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  frames_missing_ += lost_frames_.before(writer, number);
}

void IngestionQueue::number_pose(const dds::WriterId& writer, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  poses_missing_ += lost_poses_.before(writer, number);
}

std::vector<Arrival> IngestionQueue::drain() {
  Queue frames, poses;
  {
    const std::lock_guard lock(mutex_);
    frames.swap(frames_);
    poses.swap(poses_);
  }
  std::vector<Numbered> merged;
  merged.reserve(frames.size() + poses.size());
  std::merge(std::make_move_iterator(frames.begin()), std::make_move_iterator(frames.end()),
             std::make_move_iterator(poses.begin()), std::make_move_iterator(poses.end()),
             std::back_inserter(merged),
             [](const Numbered& a, const Numbered& b) { return a.order < b.order; });
  std::vector<Arrival> arrivals;
  arrivals.reserve(merged.size());
  for (auto& [order, arrival] : merged) arrivals.push_back(std::move(arrival));
  return arrivals;
}

IngestionQueue::Snapshot IngestionQueue::snapshot() const {
  const std::lock_guard lock(mutex_);
  auto result = state_;
  result.queued_frames = frames_.size();
  return result;
}

}  // namespace laneloom
