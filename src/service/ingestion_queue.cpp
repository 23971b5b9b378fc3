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

/// The name of a counter of one topic.
std::string counter(Input input, std::string_view what) {
  return std::string(kInputNames.at(static_cast<std::size_t>(input))) + "_" + std::string(what);
}
std::string refused(Input input, std::string_view reason) {
  return counter(input, "refused_") + std::string(reason);
}

}  // namespace

IngestionQueue::IngestionQueue(const Config& config, std::function<void()> frame_is_ready)
    : config_(config.sync), gate_(config.gate), frame_is_ready_(std::move(frame_is_ready)) {
  for (std::size_t i = 0; i < streams_.size(); ++i)
    state_.counters.add(counter(static_cast<Input>(i), "received"), 0);
  for (const auto* name : {"frames_dropped_queue_full", "poses_dropped_queue_full"})
    state_.counters.add(name, 0);
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
  note(Input::detections, arrival_ns);
  note_source(frame, arrival_ns);
  if (!refusal.empty()) {
    state_.counters.add(refused(Input::detections, refusal));
    return false;
  }
  if (left_out > 0) {
    state_.counters.add("frames_thinned");
    state_.counters.add("detections_left_out", left_out);
  }
  Queue& frames = queue(Input::detections);
  if (frames.size() >= static_cast<std::size_t>(config_.queue_capacity)) drop_oldest_of_most();
  const bool is_ready = readiness_.note_frame(frame.stamp_ns);
  push(frames, {std::move(frame), arrival_ns});
  return note_ready(is_ready ? 1 : 0, arrival_ns);
}

bool IngestionQueue::enqueue(VehiclePose&& pose, std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  note(Input::poses, arrival_ns);
  Queue& poses = queue(Input::poses);
  if (poses.size() >= static_cast<std::size_t>(config_.pose_queue_capacity)) {
    poses.pop_front();
    state_.counters.add("poses_dropped_queue_full");
  }
  const std::size_t ready = readiness_.note_pose(pose.stamp_ns);
  push(poses, {std::move(pose), arrival_ns});
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
  push_optional(Input::objects, std::move(objects), arrival_ns);
}

void IngestionQueue::push(NextTurn&& turn, std::int64_t arrival_ns) {
  push_optional(Input::next_turns, turn, arrival_ns);
}

template <class T>
void IngestionQueue::push_optional(Input input, T&& message, std::int64_t arrival_ns) {
  const std::string_view refusal = session::defect(message, gate_);
  const std::lock_guard lock(mutex_);
  note(input, arrival_ns);
  if (!refusal.empty()) {
    state_.counters.add(refused(input, refusal));
    return;
  }
  if (queue(input).size() >= static_cast<std::size_t>(config_.queue_capacity)) {
    queue(input).pop_front();
    state_.counters.add(counter(input, "dropped_queue_full"));
  }
  push(queue(input), {std::forward<T>(message), arrival_ns});
}

void IngestionQueue::drop_oldest_of_most() {
  const auto source_of = [](const Numbered& numbered) -> const std::string& {
    return std::get<DetectionFrame>(numbered.arrival.message).source;
  };
  Queue& frames = queue(Input::detections);
  std::map<std::string_view, std::size_t> counts;
  for (const Numbered& numbered : frames) ++counts[source_of(numbered)];
  const auto most = std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; });
  frames.erase(std::ranges::find(frames, most->first, source_of));
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

void IngestionQueue::note(Input input, std::int64_t arrival_ns) {
  if (input == Input::detections) state_.newest_frame_ns = arrival_ns;
  if (input == Input::poses) state_.newest_pose_ns = arrival_ns;
  state_.counters.add(counter(input, "received"));
  stream(input).lost_count = stream(input).lost.total();
}

void IngestionQueue::refuse(Input input, std::string_view reason, std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  note(input, arrival_ns);
  state_.counters.add(refused(input, reason));
}

void IngestionQueue::note_other_service(std::int64_t arrival_ns) {
  const std::lock_guard lock(mutex_);
  state_.other_service_ns = arrival_ns;
}

void IngestionQueue::number(Input input, const dds::WriterId& writer, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  stream(input).lost.note(writer, number);
}

core::Arrivals IngestionQueue::take() {
  core::Arrivals arrivals;
  std::array<Queue, kInputNames.size()> queues;
  {
    const std::lock_guard lock(mutex_);
    arrivals = state_;
    for (std::size_t i = 0; i < queues.size(); ++i) {
      arrivals.counters.add(counter(static_cast<Input>(i), "lost"), streams_.at(i).lost_count);
      queues.at(i) = std::exchange(streams_.at(i).queue, {});
    }
  }
  std::vector<Numbered> merged;
  for (Queue& queue : queues) std::ranges::move(queue, std::back_inserter(merged));
  std::ranges::sort(merged, {}, &Numbered::order);
  arrivals.messages.reserve(merged.size());
  for (auto& [order, arrival] : merged) arrivals.messages.push_back(std::move(arrival));
  return arrivals;
}

}  // namespace laneloom::service
