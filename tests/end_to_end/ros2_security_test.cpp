#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>

#include "VisualizationMsgsPubSubTypes.hpp"
#include "dds/topic_reader.hpp"
#include "identities.hpp"
#include "participants.hpp"
#include "process.hpp"
#include "ros2/topic.hpp"
#include "service.hpp"

// DDS-Security and the service's topics for ROS 2: as with its own, an identity and a permission for each.
namespace laneloom {
namespace {

constexpr int kNotBelieved = 77;

/// Counts the messages of laneloom/markers.
class Display {
 public:
  explicit Display(DdsConfig config) : reader_(participant(std::move(config)), topic(), take(), {}) {}

  bool wait_for_markers() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(30), [&] { return heard_ > 3; });
  }
  int heard() {
    const std::lock_guard lock(mutex_);
    return heard_;
  }

 private:
  using Readers = dds::TopicReader<visualization_msgs::msg::dds_::MarkerArray_>;

  static std::shared_ptr<dds::Participant::Impl> participant(DdsConfig config) {
    config.vehicle_id.clear();
    return std::make_shared<dds::Participant::Impl>(config, "display", dds::Participant::Presence::shown,
                                                    ros2::kParticipantUserData);
  }
  static dds::TopicDescription topic() {
    return ros2::topic<visualization_msgs::msg::dds_::MarkerArray_PubSubType>(
        "rt/car_1/laneloom/markers", "visualization_msgs/msg/MarkerArray", dds::TopicKind::view);
  }
  Readers::Take take() {
    return [this](const dds::WriterId& /*writer*/, std::uint64_t /*number*/, const auto* sample) {
      const std::lock_guard lock(mutex_);
      heard_ += sample == nullptr ? 0 : 1;
      changed_.notify_all();
    };
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  int heard_ = 0;
  Readers reader_;
};

/// The service for nodes in /car_1, with these lines more in its section.
class RosService : private TemporaryFile, public Process {
 public:
  explicit RosService(const DdsConfig& dds, const std::string& more = "")
      : TemporaryFile("laneloomd.yaml", "dds:\n  security_directory: '" + dds.security_directory +
                                            "'\nros2:\n  enabled: true\n  namespace: /car_1\n" + more),
        Process(command(dds, {"--config", path})) {}
};

TEST(Ros2Security, OnlyNodesWithAnIdentityAndAPermissionHearTheService) {
  const auto config = private_config();
  const Identities identities;
  const RosService service(identities.as("service", config), "  announce: true\n");
  Display stranger(config);
  Display node(identities.as("ros", config));
  EXPECT_TRUE(node.wait_for_markers()) << service.errors();
  EXPECT_EQ(stranger.heard(), 0);
  EXPECT_THROW(Display(identities.as("perception", config)), dds::NotPermitted);
}

TEST(Ros2Security, ATopicWithoutAPermissionStopsTheStart) {
  const Identities identities;
  RosService service(identities.as("service", private_config()), "  road_segments_topic: /elsewhere\n");
  EXPECT_EQ(service.wait(), kNotBelieved) << service.errors();
  EXPECT_NE(service.errors().find("writer of rt/elsewhere"), std::string::npos) << service.errors();
  EXPECT_NE(service.errors().find("not permitted to the identity"), std::string::npos) << service.errors();
}

}  // namespace
}  // namespace laneloom
