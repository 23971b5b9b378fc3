#include "doctor/observer.hpp"

#include <unistd.h>
#include <fastdds/dds/subscriber/DataReader.hpp>

#include <functional>
#include <optional>

#include "dds/participant_impl.hpp"
#include "dds/topic_traits.hpp"
#include "laneloom/dds/writer.hpp"
#include "own_domain.hpp"
#include "scenes.hpp"

namespace laneloom {
namespace {

using testing::HasSubstr;

DdsConfig private_config() {
  DdsConfig config;
  config.domain = own_domain();
  config.vehicle_id = "observed" + std::to_string(getpid());
  return config;
}

/// The first finding with this id, within 20 s.
std::optional<Finding> wait_for(const Observer& observer, const std::string& id) {
  for (int i = 0; i < 400; ++i) {
    for (const Finding& finding : findings(observer.observed()))
      if (finding.id == id) return finding;
    usleep(50'000);
  }
  return std::nullopt;
}

TEST(Observer, SeesAReaderThatAsksForTooMuch) {
  const DdsConfig config = private_config();
  const dds::Participant service(config, "a service");
  const dds::Writer<PublishedMap> map(service);
  const dds::Participant planner(config, "a planner");
  using Traits = dds::TopicTraits<PublishedMap>;
  auto qos = dds::reader_qos(Traits::kKind, eprosima::fastdds::dds::RELIABLE_RELIABILITY_QOS);
  qos.deadline().period = eprosima::fastrtps::Duration_t(0, 100'000'000);
  auto* topic = planner.impl()->topic(Traits::kName, eprosima::fastdds::dds::TypeSupport(new Traits::Type));
  ASSERT_TRUE(planner.impl()->subscriber().create_datareader(topic, qos));

  const auto found = wait_for(Observer(config), "qos_mismatch");
  ASSERT_TRUE(found);
  EXPECT_THAT(found->found, HasSubstr("\"a service\""));
  EXPECT_THAT(found->found, HasSubstr("\"a planner\""));
  EXPECT_THAT(found->found, HasSubstr("deadline (offered: 0.25 s, requested: 0.1 s)"));
}

TEST(Observer, SeesStampsOfDifferentClocks) {
  const DdsConfig config = private_config();
  const dds::Participant sensors(config, "sensors");
  dds::Writer<DetectionFrame> detections(sensors);
  dds::Writer<VehiclePose> poses(sensors);
  const Observer observer(config);
  std::optional<Finding> found;
  for (int i = 0; i < 400 && !found; ++i) {
    detections.write(DetectionFrame{.stamp_ns = 1'000'000'000});
    poses.write(VehiclePose{.stamp_ns = 61'000'000'000});
    for (const Finding& finding : findings(observer.observed()))
      if (finding.id == "sensor_clocks") found = finding;
    usleep(50'000);
  }
  ASSERT_TRUE(found);
  // Less what lies between their arrivals.
  EXPECT_THAT(
      found->found,
      testing::ContainsRegex("Stamps of detections are (59\\.[5-9]|60\\.[0-9]) s behind those of poses\\."));
}

TEST(Observer, SeesWhatAServiceWouldRefuse) {
  const DdsConfig config = private_config();
  DdsConfig another_frame = config;
  another_frame.map_frame_id = "utm";
  const dds::Participant sensors(another_frame, "sensors");
  dds::Writer<VehiclePose> poses(sensors);
  const Observer observer(config);
  Observed seen;
  for (int i = 0; i < 400 && seen.poses.refused.empty(); ++i) {
    poses.write(VehiclePose{.stamp_ns = 1});
    usleep(50'000);
    seen = observer.observed();
  }
  EXPECT_GT(seen.poses.refused["wrong_frame"], 0U);
  EXPECT_TRUE(seen.poses.newest) << "its clock can be judged all the same";
}

TEST(Observer, TakesTheMapFrameFromTheService) {
  const DdsConfig config = private_config();
  DdsConfig of_service = config;
  of_service.map_frame_id = "odom";
  const dds::Participant vehicle(of_service, "vehicle");
  dds::Writer<VehiclePose> poses(vehicle);
  dds::Writer<ServiceStatus> status(vehicle);
  status.write(ServiceStatus{.configuration = {{"dds.map_frame_id", "odom"}}});
  const Observer observer(config);
  Observed seen;
  for (int i = 0; i < 400 && (seen.poses.messages < 3 || seen.dds.map_frame_id != "odom"); ++i) {
    poses.write(VehiclePose{.stamp_ns = 1});
    usleep(50'000);
    seen = observer.observed();
  }
  EXPECT_EQ(seen.dds.map_frame_id, "odom");
  EXPECT_THAT(seen.poses.refused, testing::IsEmpty());
}

}  // namespace
}  // namespace laneloom
