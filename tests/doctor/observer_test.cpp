#include "doctor/observer.hpp"

#include <unistd.h>
#include <fastdds/dds/subscriber/DataReader.hpp>

#include <fstream>
#include <functional>
#include <optional>

#include "dds/participant_impl.hpp"
#include "dds/topic_traits.hpp"
#include "laneloom/dds/writer.hpp"
#include "own_domain.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

namespace laneloom::doctor {
namespace {

using testing::HasSubstr;
using testing::Not;

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

Detection line_of(double confidence) { return {.confidence = confidence, .points = {{0, 1, 0}, {9, 1, 0}}}; }

TEST(Observer, SeesAReaderThatAsksForTooMuch) {
  const DdsConfig config = private_config();
  const dds::Participant service(config, "a service");
  const dds::Writer<PublishedMap> map(service);
  const dds::Participant planner(config, "a planner");
  using Traits = dds::TopicTraits<PublishedMap>;
  auto qos = dds::reader_qos(Traits::kKind, eprosima::fastdds::dds::RELIABLE_RELIABILITY_QOS);
  qos.deadline().period = eprosima::fastdds::dds::Duration_t(0, 100'000'000);
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

// The messages and their writers are real.
TEST(Observer, SeesTwoWritersOfOneSource) {
  const DdsConfig config = private_config();
  const dds::Participant front(config, "front"), rear(config, "rear"), side(config, "side");
  dds::Writer<DetectionFrame> one(front), other(rear), third(side);
  const Observer observer(config);
  std::optional<Finding> found;
  for (std::uint64_t i = 1; i < 400 && !found; ++i) {
    const DetectionFrame frame{.stamp_ns = 1, .sequence = i, .session_id = 1, .source = "camera"};
    DetectionFrame of_side = frame;
    of_side.source = "side";
    one.write(frame);
    usleep(25'000);
    other.write(frame);
    third.write(of_side);
    usleep(25'000);
    for (const Finding& finding : findings(observer.observed()))
      if (finding.id == "source_of_several_writers") found = finding;
  }
  ASSERT_TRUE(found);
  EXPECT_THAT(found->found, HasSubstr("\"camera\": \"front\" ("));
  EXPECT_THAT(found->found, HasSubstr(", \"rear\" ("));
  EXPECT_THAT(found->found, Not(HasSubstr("side")));
}

TEST(Observer, JudgesEachSourceByItself) {
  const DdsConfig config = private_config();
  const dds::Participant front(config, "front"), rear(config, "rear");
  dds::Writer<DetectionFrame> one(front), other(rear);
  const Observer observer(config);
  Observed seen;
  for (std::uint64_t i = 1;
       i < 400 && (seen.sources["front"].messages < 5 || seen.sources["rear"].messages < 5); ++i) {
    one.write(DetectionFrame{.stamp_ns = 1,
                             .sequence = i,
                             .session_id = 1,
                             .source = "front",
                             .field_of_view = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}},
                             .detections = {line_of(0.2), line_of(0.4)}});
    other.write(DetectionFrame{.stamp_ns = 1, .sequence = 0, .session_id = 2, .source = "rear"});
    usleep(50'000);
    seen = observer.observed();
  }
  EXPECT_EQ(seen.sources["front"].unnumbered, 0U);
  EXPECT_EQ(seen.drive.frames["front"].size(), seen.sources["front"].messages)
      << "kept, to see whether they fit";
  EXPECT_EQ(seen.sources["front"].without_view, 0U);
  EXPECT_GE(seen.sources["rear"].unnumbered, 4U) << "though another's came between";
  EXPECT_GE(seen.sources["rear"].without_view, 5U);
  EXPECT_EQ(seen.sources["front"].best_confidence, 0.4);
  EXPECT_EQ(seen.sources["rear"].best_confidence, -1.0) << "it detects nothing";
}

TEST(Observer, LooksIntoTheProfileOfTheService) {
  const DdsConfig config = private_config();
  const TemporaryFolder folder;
  std::ofstream(folder.file("small.xml"))
      << R"(<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <transport_descriptors><transport_descriptor>
    <transport_id>udp</transport_id><type>UDPv4</type><maxMessageSize>1400</maxMessageSize>
  </transport_descriptor></transport_descriptors>
  <participant profile_name="small"><rtps>
    <userTransports><transport_id>udp</transport_id></userTransports><useBuiltinTransports>false</useBuiltinTransports>
  </rtps></participant>
</profiles>)";
  const dds::Participant vehicle(config, "vehicle");
  dds::Writer<ServiceStatus> status(vehicle);
  status.write(ServiceStatus{
      .session_id = 1,
      .configuration = {{"dds.profile_file", folder.file("small.xml")}, {"dds.profile_name", "small"}}});
  status.write(ServiceStatus{
      .session_id = 1,
      .configuration = {{"dds.profile_file", folder.file("small.xml")}, {"dds.profile_name", "small"}}});
  const auto found = wait_for(Observer(config), "datagrams_cut");
  ASSERT_TRUE(found);
  EXPECT_THAT(found->found, HasSubstr("more than 1400 bytes"));
  EXPECT_THAT(found->found, HasSubstr(folder.file("small.xml")));
}

}  // namespace
}  // namespace laneloom::doctor
