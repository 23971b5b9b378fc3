#include "service/endpoints.hpp"

#include <algorithm>
#include <utility>

namespace laneloom::service {
namespace {

dds::ReaderCallbacks<DetectionFrame> take_detections(IngestionQueue& queue,
                                                     const std::function<std::int64_t()>& now_ns) {
  dds::ReaderCallbacks<DetectionFrame> callbacks;
  callbacks.sample = [&queue, now_ns](DetectionFrame&& frame) { queue.push(std::move(frame), now_ns()); };
  callbacks.refused = [&queue, now_ns](std::string_view reason) {
    queue.refuse_detections(reason, now_ns());
  };
  callbacks.numbered = [&queue](const dds::WriterId& writer, std::uint64_t number) {
    queue.number_detections(writer, number);
  };
  return callbacks;
}

dds::ReaderCallbacks<VehiclePose> take_poses(IngestionQueue& queue,
                                             const std::function<std::int64_t()>& now_ns) {
  dds::ReaderCallbacks<VehiclePose> callbacks;
  callbacks.sample = [&queue, now_ns](VehiclePose&& pose) { queue.push(std::move(pose), now_ns()); };
  callbacks.refused = [&queue, now_ns](std::string_view reason) { queue.refuse_pose(reason, now_ns()); };
  callbacks.numbered = [&queue](const dds::WriterId& writer, std::uint64_t number) {
    queue.number_pose(writer, number);
  };
  return callbacks;
}

dds::ReaderCallbacks<TrackedObjects> take_objects(IngestionQueue& queue,
                                                  const std::function<std::int64_t()>& now_ns) {
  dds::ReaderCallbacks<TrackedObjects> callbacks;
  callbacks.sample = [&queue, now_ns](TrackedObjects&& objects) { queue.push(std::move(objects), now_ns()); };
  callbacks.refused = [&queue](std::string_view reason) { queue.refuse_objects(reason); };
  callbacks.numbered = [&queue](const dds::WriterId& writer, std::uint64_t number) {
    queue.number_objects(writer, number);
  };
  return callbacks;
}

dds::ReaderCallbacks<ServiceStatus> look_for_others(std::uint64_t session_id, IngestionQueue& queue,
                                                    const std::function<std::int64_t()>& now_ns) {
  dds::ReaderCallbacks<ServiceStatus> callbacks;
  callbacks.sample = [session_id, &queue, now_ns](ServiceStatus&& status) {
    if (status.session_id != session_id) queue.note_other_service(now_ns());
  };
  return callbacks;
}

}  // namespace

Endpoints::Endpoints(const Config& config, std::uint64_t session_id, IngestionQueue& queue,
                     const std::function<std::int64_t()>& now_ns, dds::Participant::Presence presence)
    : participant_(config.dds, "laneloomd", presence),
      map(participant_),
      road_markings(participant_),
      status(participant_),
      detections_(participant_, take_detections(queue, now_ns)),
      poses_(participant_, take_poses(queue, now_ns)),
      objects_(participant_, take_objects(queue, now_ns)),
      services_(participant_, look_for_others(session_id, queue, now_ns)) {
  if (!config.ros2.enabled) return;
  ros2 = std::make_unique<ros2::Endpoints>(
      config,
      ros2::Inputs{take_detections(queue, now_ns), take_poses(queue, now_ns), take_objects(queue, now_ns)},
      presence);
}

Counters Endpoints::refused_datagrams() const {
  Counters result = participant_.refused_datagrams();
  if (ros2) result.add(ros2->refused_datagrams());
  return result;
}

dds::SelfCheck Endpoints::ask_itself() {
  const dds::SelfCheck own = participant_.ask_itself();
  const dds::SelfCheck of_ros2 = ros2 ? ros2->ask_itself() : dds::SelfCheck{};
  return {std::max(own.unanswered, of_ros2.unanswered), own.address_gone || of_ros2.address_gone};
}

}  // namespace laneloom::service
