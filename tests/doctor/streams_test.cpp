#include "scenes.hpp"

namespace laneloom::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Streams, AWriterOfWhichNothingComes) {
  Observed seen = healthy();
  seen.detections = {};
  seen.sources.clear();
  const Findings found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("detections_silent"));
  EXPECT_EQ(found[0].found, "\"perception\" (10.0.0.1) writes detections, but none came within 3.0 s.");
  seen.endpoints.erase(seen.endpoints.begin() + 1);
  EXPECT_THAT(stream_findings(seen), IsEmpty()) << "nobody writes: topic_findings() say so";
}

TEST(Streams, OfAWriterOfAnotherTypeNothingCanCome) {
  Observed seen = healthy();
  seen.detections = {};
  seen.sources.clear();
  seen.endpoints[1].type = "my::Detections";
  seen.poses = {};
  seen.endpoints[2].type = "my::Pose";
  EXPECT_THAT(stream_findings(seen), IsEmpty()) << "topic_findings() say so";
}

TEST(Streams, Rates) {
  const auto found_at = [](std::uint64_t detections, std::uint64_t poses, double window_s) {
    Observed seen = healthy();
    InputObserved& camera = seen.sources.at("camera");
    seen.detections.messages = camera.messages = detections;
    seen.poses.messages = poses;
    seen.detections.window_s = camera.window_s = seen.poses.window_s = window_s;
    return ids(stream_findings(seen));
  };
  EXPECT_THAT(found_at(9, 41, 2.0), IsEmpty());      // 4 and 20 a second
  EXPECT_THAT(found_at(101, 4001, 2.0), IsEmpty());  // 50 and 2000
  EXPECT_THAT(found_at(30, 60, 2.97), IsEmpty()) << "20 poses a second, and the window ends before the next";
  EXPECT_THAT(found_at(7, 41, 2.3), ElementsAre("detections_slow", "poses_slow"));
  EXPECT_THAT(found_at(102, 41, 2.0), ElementsAre("detections_fast"));
  EXPECT_THAT(found_at(1, 1, 0.9), IsEmpty()) << "too early to tell";
}

TEST(Streams, ObjectsAreJudgedWhereSomebodyWritesThem) {
  Observed seen = healthy();
  seen.endpoints.push_back(endpoint(true, "tracker", dds::kObjectsTopic, dds::kObjectsType));
  EXPECT_THAT(ids(stream_findings(seen)), ElementsAre("objects_silent"));
  seen.objects = {.messages = 26, .window_s = 2.5, .newest = {{50'000'000'000, 2'000'000'000}}};
  EXPECT_THAT(stream_findings(seen), IsEmpty());
  seen.objects.messages = 3;
  seen.objects.unnumbered = 2;
  seen.objects.newest->stamp_ns -= 10'000'000'000;
  EXPECT_THAT(ids(stream_findings(seen)), ElementsAre("objects_slow", "objects_unnumbered", "sensor_clocks"));
}

TEST(Streams, TwoWritersOfPosesAreNamed) {
  Observed seen = healthy();
  auto second = pose_writer();
  second.participant.name = "second odometry";
  seen.endpoints.push_back(second);
  const Findings found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("poses_two_writers"));
  EXPECT_THAT(found[0].found, HasSubstr("second odometry"));
  seen = healthy();
  seen.endpoints.push_back(detections_writer());
  EXPECT_THAT(stream_findings(seen), IsEmpty()) << "two cameras are two sources";
}

TEST(Streams, TheRateOfEachSourceCounts) {
  Observed seen = healthy();
  seen.sources["rear"] = {.messages = 4, .window_s = 3.0};
  const Findings found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("detections_slow"));
  EXPECT_EQ(found[0].found, "1.0 detections of source \"rear\" come in a second; it should be 4 at least.");
}

TEST(Streams, ASequenceNumberThatStays) {
  Observed seen = healthy();
  seen.sources.at("camera").unnumbered = 25;
  const Findings found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("detections_unnumbered"));
  EXPECT_EQ(found[0].found, "25 detections have the sequence_number of the one before.");
}

TEST(Streams, AProfileThatCutsDatagrams) {
  Observed seen = healthy();
  seen.dds.profile_file = "small.xml";
  seen.largest_datagram = 1400;
  const Findings found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("datagrams_cut"));
  EXPECT_THAT(found[0].found, HasSubstr("more than 1400 bytes"));
  EXPECT_THAT(found[0].found, HasSubstr("small.xml"));
}

// Without --config, the doctor has the settings of Fast DDS.
TEST(Streams, AProfileOfTheServiceThatCutsDatagrams) {
  Observed seen = healthy();
  seen.services[0].profile_file = "small.xml";
  EXPECT_THAT(stream_findings(seen), IsEmpty());
  seen.services[0].largest_datagram = 1400;
  Findings found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("datagrams_cut"));
  EXPECT_THAT(found[0].found, HasSubstr("small.xml"));
  seen.services[0].largest_datagram.reset();
  found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("profile_unread"));
  EXPECT_TRUE(found[0].advice);
}

TEST(Streams, DetectionsAndPosesOfDifferentClocks) {
  // In healthy(), detections are 90 ms behind poses: 50.0 s at 2.0 s, and 50.1 s at 2.01 s.
  Observed seen = healthy();
  seen.sources.at("camera").newest->stamp_ns -= 400'000'000;
  EXPECT_THAT(stream_findings(seen), IsEmpty());
  seen.sources.at("camera").newest->stamp_ns -= 20'000'000;
  Findings found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("sensor_clocks"));
  EXPECT_EQ(found[0].found, "Stamps of detections are 0.5 s behind those of poses.");
  seen.sources.at("camera").newest->stamp_ns = 3'650'100'000'000;
  found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("sensor_clocks"));
  EXPECT_EQ(found[0].found, "Stamps of detections are 3600.0 s ahead of those of poses.");

  // Poses that stopped a second ago are not of another clock.
  seen = healthy();
  seen.poses.newest->stamp_ns -= 1'000'000'000;
  seen.poses.newest->arrival_ns -= 1'000'000'000;
  EXPECT_THAT(stream_findings(seen), IsEmpty());
}

TEST(Streams, AHostWithAnotherClock) {
  Observed seen = healthy();
  seen.services[0].clock_offset_s = -2.0;
  const Findings found = stream_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("host_clocks"));
  EXPECT_EQ(found[0].found, "The system clock of the service's host is 2.0 s ahead of the one here.");
  seen.services[0].statuses = 1;
  EXPECT_THAT(stream_findings(seen), IsEmpty()) << "it may have been kept for late joiners";
}

}  // namespace
}  // namespace laneloom::doctor
