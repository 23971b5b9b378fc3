#include "laneloom/dds/discovery.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "dds/topic_traits.hpp"
#include "laneloom/dds/reader.hpp"
#include "laneloom/dds/writer.hpp"
#include "own_domain.hpp"

namespace laneloom::dds {
namespace {

DdsConfig private_config() {
  DdsConfig config;
  config.domain = own_domain();
  config.vehicle_id = "seen" + std::to_string(getpid());
  return config;
}

bool wait_for(const std::function<bool()>& condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) usleep(10'000);
  return condition();
}

/// The endpoint of this topic in the partition of `config`.
std::optional<Endpoint> find(const Discovery& discovery, const DdsConfig& config, const char* topic) {
  const std::vector<std::string> partitions{config.vehicle_id};
  const auto all = discovery.endpoints();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Endpoint& endpoint) {
    return endpoint.topic == topic && endpoint.partitions == partitions;
  });
  if (found == all.end()) return std::nullopt;
  return *found;
}

TEST(Discovery, TellsWhoWritesAndReadsWhatAndHow) {
  const DdsConfig config = private_config();
  DdsConfig elsewhere = config;
  elsewhere.vehicle_id = "nobody";
  const Discovery discovery(elsewhere, "watcher");
  const Participant participant(config, "someone");
  const Writer<PublishedMap> writer(participant);
  const Reader<DetectionFrame> reader(participant, {});
  ASSERT_TRUE(wait_for(
      [&] { return find(discovery, config, kLaneMapTopic) && find(discovery, config, kDetectionsTopic); }));

  const Endpoint map = *find(discovery, config, kLaneMapTopic);
  EXPECT_TRUE(map.is_writer);
  EXPECT_EQ(map.participant.name, "someone");
  EXPECT_FALSE(map.participant.id.empty());
  EXPECT_FALSE(map.participant.address.empty());
  EXPECT_EQ(map.type, kLaneMapType);
  EXPECT_TRUE(map.reliable);
  EXPECT_EQ(map.durability, Durability::transient_local);
  EXPECT_EQ(map.deadline_s, 0.25);
  EXPECT_EQ(map.liveliness, Liveliness::manual_by_topic);
  EXPECT_EQ(map.lease_s, 0.4);
  EXPECT_FALSE(map.exclusive);

  const Endpoint detections = *find(discovery, config, kDetectionsTopic);
  EXPECT_FALSE(detections.is_writer);
  EXPECT_EQ(detections.type, kDetectionsType);
  EXPECT_FALSE(detections.reliable);
  EXPECT_EQ(detections.durability, Durability::volatile_);
  EXPECT_EQ(detections.deadline_s, std::nullopt);
  EXPECT_EQ(detections.liveliness, Liveliness::automatic);
  EXPECT_EQ(detections.lease_s, std::nullopt);
}

TEST(Discovery, ForgetsWhoLeaves) {
  const DdsConfig config = private_config();
  const Discovery discovery(config, "watcher");
  const auto is_there = [&](const std::string& name) {
    const auto all = discovery.participants();
    return std::any_of(all.begin(), all.end(), [&](const Peer& peer) { return peer.name == name; });
  };
  {
    const Participant participant(config, "a guest");
    auto writer = std::make_unique<Writer<VehiclePose>>(participant);
    ASSERT_TRUE(wait_for([&] { return find(discovery, config, kVehiclePoseTopic).has_value(); }));
    writer.reset();
    EXPECT_TRUE(wait_for([&] { return !find(discovery, config, kVehiclePoseTopic); }));
    EXPECT_TRUE(is_there("a guest"));
  }
  EXPECT_TRUE(wait_for([&] { return !is_there("a guest"); }));
  EXPECT_FALSE(is_there("watcher")) << "it sees itself";
}

TEST(Discovery, TypesHaveTheNamesThatTheTopicsTell) {
  const auto type_of = []<class T>(const T&) {
    return topic_of<T, typename TopicTraits<T>::Type>().type.get_type_name();
  };
  EXPECT_EQ(type_of(DetectionFrame()), kDetectionsType);
  EXPECT_EQ(type_of(VehiclePose()), kVehiclePoseType);
  EXPECT_EQ(type_of(PublishedMap()), kLaneMapType);
  EXPECT_EQ(type_of(RoadMarkings()), kRoadMarkingsType);
  EXPECT_EQ(type_of(ServiceStatus()), kStatusType);
}

}  // namespace
}  // namespace laneloom::dds
