#include "ros2/endpoints.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "AutowareMaplessPlanningMsgsPubSubTypes.hpp"
#include "DiagnosticMsgsPubSubTypes.hpp"
#include "VisualizationMsgsPubSubTypes.hpp"
#include "cdr/convert.hpp"
#include "dds/topic_writer.hpp"
#include "ros2/announcement.hpp"
#include "ros2/diagnostics.hpp"
#include "ros2/input_readers.hpp"
#include "ros2/markers.hpp"
#include "ros2/other_writers.hpp"
#include "ros2/road_segments.hpp"
#include "ros2/topic.hpp"

namespace laneloom::ros2 {
namespace {

using autoware_mapless_planning_msgs::msg::dds_::RoadSegments_PubSubType;
using dds::TopicKind;
using diagnostic_msgs::msg::dds_::DiagnosticArray_PubSubType;
using visualization_msgs::msg::dds_::MarkerArray_PubSubType;

constexpr const char* kMapTopic = "laneloom/lane_map";

}  // namespace

class Endpoints::Impl {
 public:
  Impl(const Config& config, Inputs inputs, dds::Participant::Presence presence)
      : config_(config),
        participant_(make_participant(config.dds, "laneloomd for ROS 2", presence)),
        others_(participant_->participant(), dds_topic(config.ros2, kMapTopic)),
        map_(participant_, topic<dds::CheckedType<msg::LaneMapPubSubType>>(
                               config.ros2, kMapTopic, "laneloom_msgs/msg/LaneMap", TopicKind::map)),
        markers_writer_(participant_,
                        topic<MarkerArray_PubSubType>(config.ros2, "laneloom/markers",
                                                      "visualization_msgs/msg/MarkerArray", TopicKind::view)),
        segments_(participant_, topic<RoadSegments_PubSubType>(
                                    config.ros2, config.ros2.road_segments_topic,
                                    "autoware_mapless_planning_msgs/msg/RoadSegments", TopicKind::view)),
        diagnostics_(participant_, topic<DiagnosticArray_PubSubType>(config.ros2, "/diagnostics",
                                                                     "diagnostic_msgs/msg/DiagnosticArray",
                                                                     TopicKind::status)),
        inputs_(participant_, config, std::move(inputs)) {
    if (config.ros2.announce) announcement_ = announce(participant_, config.ros2);
  }

  std::size_t write(const PublishedMap& map) {
    dds::to_msg(map, config_.dds.map_frame_id, map_sample_.message);
    auto markers = markers_.update(map);
    std::size_t failed = (map_.write(&map_sample_) ? 0U : 1U) + (markers_writer_.write(&markers) ? 0U : 1U);
    // The message has no room for the state.
    if (!may_drive_on(map)) return failed;
    auto segments = to_road_segments(map);
    failed += segments_.write(&segments) ? 0U : 1U;
    return failed;
  }
  bool has_another_writer() const { return others_.any(); }
  Counters refused_datagrams() const { return participant_->refused_datagrams(); }
  dds::SelfCheck ask_itself() { return participant_->ask_itself(); }
  std::size_t write(const ServiceStatus& status) {
    auto diagnostics = to_diagnostics(status, full_node_name(config_.ros2), config_.dds.vehicle_id);
    return diagnostics_.write(&diagnostics) ? 0 : 1;
  }

 private:
  Config config_;
  std::shared_ptr<dds::Participant::Impl> participant_;
  OtherWriters others_;
  Markers markers_;
  dds::Sample<msg::LaneMap> map_sample_;  // kept, so that its memory is reused
  dds::TopicWriter map_, markers_writer_, segments_, diagnostics_;
  InputReaders inputs_;
  std::unique_ptr<dds::TopicWriter> announcement_;  ///< null: there is none
};

Endpoints::Endpoints(const Config& config, Inputs inputs, dds::Participant::Presence presence)
    : impl_(std::make_unique<Impl>(config, std::move(inputs), presence)) {}
Endpoints::~Endpoints() = default;

std::size_t Endpoints::write(const PublishedMap& map) { return impl_->write(map); }
std::size_t Endpoints::write(const ServiceStatus& status) { return impl_->write(status); }
bool Endpoints::has_another_writer() const { return impl_->has_another_writer(); }
Counters Endpoints::refused_datagrams() const { return impl_->refused_datagrams(); }
dds::SelfCheck Endpoints::ask_itself() { return impl_->ask_itself(); }

}  // namespace laneloom::ros2
