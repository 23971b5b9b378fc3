#include "service/endpoints.hpp"

#include <algorithm>
#include <utility>

namespace laneloom::service {
namespace {

template <class T>
dds::ReaderCallbacks<T> take(Input input, IngestionQueue& queue,
                             const std::function<std::int64_t()>& now_ns) {
  dds::ReaderCallbacks<T> callbacks;
  callbacks.sample = [&queue, now_ns](T&& message) { queue.push(std::move(message), now_ns()); };
  callbacks.refused = [input, &queue, now_ns](std::string_view reason) {
    queue.refuse(input, reason, now_ns());
  };
  callbacks.numbered = [input, &queue](const dds::WriterId& writer, std::uint64_t number) {
    queue.number(input, writer, number);
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
      detections_(participant_, take<DetectionFrame>(Input::detections, queue, now_ns)),
      poses_(participant_, take<VehiclePose>(Input::poses, queue, now_ns)),
      objects_(participant_, take<TrackedObjects>(Input::objects, queue, now_ns)),
      next_turns_(participant_, take<NextTurn>(Input::next_turns, queue, now_ns)),
      services_(participant_, look_for_others(session_id, queue, now_ns)) {
  if (!config.ros2.enabled) return;
  ros2 =
      std::make_unique<ros2::Endpoints>(config,
                                        ros2::Inputs{take<DetectionFrame>(Input::detections, queue, now_ns),
                                                     take<VehiclePose>(Input::poses, queue, now_ns),
                                                     take<TrackedObjects>(Input::objects, queue, now_ns),
                                                     take<NextTurn>(Input::next_turns, queue, now_ns)},
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
