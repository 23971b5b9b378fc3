#include "ros2/endpoints.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "AutowareMaplessPlanningMsgsPubSubTypes.hpp"
#include "DiagnosticMsgsPubSubTypes.hpp"
#include "VisualizationMsgsPubSubTypes.hpp"
#include "cdr/convert.hpp"
#include "dds/topic_writer.hpp"
#include "ros2/announcement.hpp"
#include "ros2/diagnostics.hpp"
#include "ros2/input.hpp"
#include "ros2/markers.hpp"
#include "ros2/road_segments.hpp"
#include "ros2/topic.hpp"

namespace laneloom::ros2 {
namespace {

using autoware_mapless_planning_msgs::msg::dds_::RoadSegments_PubSubType;
using autoware_perception_msgs::msg::dds_::TrackedObjects_;
using dds::TopicKind;
using diagnostic_msgs::msg::dds_::DiagnosticArray_PubSubType;
using nav_msgs::msg::dds_::Odometry_;
using visualization_msgs::msg::dds_::MarkerArray_PubSubType;

bool is_to_drive_on(const PublishedMap& map) {
  return map.state != MapState::stale &&
         std::ranges::find(map.reasons, StateReason::another_service) == map.reasons.end();
}

/// Nodes of ROS are in no partition.
std::shared_ptr<dds::Participant::Impl> make_participant(const Config& config,
                                                         dds::Participant::Presence presence) {
  DdsConfig dds = config.dds;
  dds.vehicle_id.clear();
  return std::make_shared<dds::Participant::Impl>(dds, "laneloomd for ROS 2", presence, kParticipantUserData);
}

}  // namespace

class Endpoints::Impl {
 public:
  Impl(const Config& config, Inputs inputs, dds::Participant::Presence presence)
      : config_(config),
        participant_(make_participant(config, presence)),
        map_(participant_, relative<dds::CheckedType<msg::LaneMapPubSubType>>(
                               "laneloom/lane_map", "laneloom_msgs/msg/LaneMap", TopicKind::map)),
        markers_writer_(participant_,
                        relative<MarkerArray_PubSubType>(
                            "laneloom/markers", "visualization_msgs/msg/MarkerArray", TopicKind::view)),
        segments_(participant_, relative<RoadSegments_PubSubType>(
                                    config.ros2.road_segments_topic,
                                    "autoware_mapless_planning_msgs/msg/RoadSegments", TopicKind::view)),
        diagnostics_(participant_,
                     relative<DiagnosticArray_PubSubType>(
                         "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", TopicKind::status)),
        detections_(participant_,
                    relative<dds::CheckedType<msg::DetectionsPubSubType>>(kDetectionsTopic, kDetectionsType,
                                                                          TopicKind::detections),
                    std::move(inputs.detections),
                    with_map_frame<msg::Detections&&, DetectionFrame>(dds::from_msg)),
        odometry_(participant_,
                  relative<OdometryType>(config.ros2.odometry_topic, kOdometryType, TopicKind::poses),
                  std::move(inputs.poses), with_map_frame<const Odometry_&, VehiclePose>(from_ros)),
        objects_(
            participant_, relative<ObjectsType>(config.ros2.objects_topic, kObjectsType, TopicKind::objects),
            std::move(inputs.objects), with_map_frame<const TrackedObjects_&, TrackedObjects>(from_ros)) {
    if (config.ros2.announce) announcement_ = announce(participant_, config.ros2);
  }

  std::size_t write(const PublishedMap& map) {
    dds::to_msg(map, config_.dds.map_frame_id, map_sample_.message);
    auto markers = markers_.update(map);
    std::size_t failed = (map_.write(&map_sample_) ? 0U : 1U) + (markers_writer_.write(&markers) ? 0U : 1U);
    // The message has no room for the state.
    if (!is_to_drive_on(map)) return failed;
    auto segments = to_road_segments(map);
    failed += segments_.write(&segments) ? 0U : 1U;
    return failed;
  }
  Counters refused_datagrams() const { return participant_->refused_datagrams(); }
  int ask_itself() { return participant_->ask_itself(); }
  std::size_t write(const ServiceStatus& status) {
    auto diagnostics = to_diagnostics(status, full_node_name(config_.ros2), config_.dds.vehicle_id);
    return diagnostics_.write(&diagnostics) ? 0 : 1;
  }

 private:
  template <class Type>
  dds::TopicDescription relative(const std::string& name, std::string_view ros_type, TopicKind kind) const {
    return topic<Type>(dds_topic(config_.ros2, name), ros_type, kind);
  }
  /// `From` is a message as `convert` takes it.
  template <class From, class T>
  typename Input<std::remove_cvref_t<From>, T>::Convert with_map_frame(
      std::string_view (*convert)(From, const std::string&, T&)) const {
    return [convert, frame = config_.dds.map_frame_id](std::remove_cvref_t<From>&& from, T& to) {
      return convert(std::move(from), frame, to);
    };
  }

  Config config_;
  std::shared_ptr<dds::Participant::Impl> participant_;
  Markers markers_;
  dds::Sample<msg::LaneMap> map_sample_;  // kept, so that its memory is reused
  dds::TopicWriter map_, markers_writer_, segments_, diagnostics_;
  Input<msg::Detections, DetectionFrame> detections_;
  Input<Odometry_, VehiclePose> odometry_;
  Input<TrackedObjects_, TrackedObjects> objects_;
  std::unique_ptr<dds::TopicWriter> announcement_;  ///< null: there is none
};

Endpoints::Endpoints(const Config& config, Inputs inputs, dds::Participant::Presence presence)
    : impl_(std::make_unique<Impl>(config, std::move(inputs), presence)) {}
Endpoints::~Endpoints() = default;

std::size_t Endpoints::write(const PublishedMap& map) { return impl_->write(map); }
std::size_t Endpoints::write(const ServiceStatus& status) { return impl_->write(status); }
Counters Endpoints::refused_datagrams() const { return impl_->refused_datagrams(); }
int Endpoints::ask_itself() { return impl_->ask_itself(); }

}  // namespace laneloom::ros2
