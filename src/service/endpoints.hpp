#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "laneloom/config.hpp"
#include "laneloom/counters.hpp"
#include "laneloom/dds/participant.hpp"
#include "laneloom/dds/reader.hpp"
#include "laneloom/dds/writer.hpp"
#include "laneloom/messages.hpp"
#include "ros2/endpoints.hpp"
#include "service/ingestion_queue.hpp"

namespace laneloom::service {

/// All DDS endpoints of the service, as one object that can be made anew while the map lives on.
class Endpoints {
 public:
  /// Messages that arrive are put into `queue`, which must outlive this. The queue is also told when a status
  /// of the same vehicle comes from a service other than `session_id`. Throws as dds::Participant().
  Endpoints(const Config& config, std::uint64_t session_id, IngestionQueue& queue,
            const std::function<std::int64_t()>& now_ns,
            dds::Participant::Presence presence = dds::Participant::Presence::shown);

  /// As dds::Participant::refused_datagrams(), of all participants.
  Counters refused_datagrams() const;
  /// As dds::Participant::ask_itself(), of all participants.
  dds::SelfCheck ask_itself();

 private:
  dds::Participant participant_;

 public:
  dds::Writer<PublishedMap> map;
  dds::Writer<RoadMarkings> road_markings;
  dds::Writer<ServiceStatus> status;
  std::unique_ptr<ros2::Endpoints> ros2;  ///< null: not enabled

 private:
  dds::Reader<DetectionFrame> detections_;
  dds::Reader<VehiclePose> poses_;
  dds::Reader<TrackedObjects> objects_;
  dds::Reader<NextTurn> next_turns_;
  dds::Reader<ServiceStatus> services_;
};

}  // namespace laneloom::service
