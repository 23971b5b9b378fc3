#include "scenes.hpp"

namespace laneloom::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr std::size_t kDetections = 1, kPoses = 2, kPlanner = 3;  // in healthy()

TEST(Topics, NobodyWritesAnInput) {
  for (const auto& [at, id] : {std::pair(kDetections, "no_detections"), std::pair(kPoses, "no_poses")}) {
    Observed seen = healthy();
    seen.endpoints.erase(seen.endpoints.begin() + static_cast<std::ptrdiff_t>(at));
    EXPECT_THAT(ids(topic_findings(seen)), ElementsAre(id));
  }
}

TEST(Topics, ObjectsNeedNotBeWritten) {
  Observed seen = healthy();
  EXPECT_THAT(topic_findings(seen), IsEmpty());
  seen.endpoints.push_back(endpoint(true, "tracker", "laneloom/v3/Objects", dds::kObjectsType));
  EXPECT_THAT(ids(topic_findings(seen)), ElementsAre("similar_topic"));
  seen.endpoints.back() = endpoint(true, "tracker", dds::kObjectsTopic, "my::Objects");
  EXPECT_THAT(ids(topic_findings(seen)), ElementsAre("wrong_type"));
}

TEST(Topics, WhatNobodyWritesMayBeInAnotherDomain) {
  Observed seen = healthy();
  seen.endpoints.erase(seen.endpoints.begin() + static_cast<std::ptrdiff_t>(kDetections));
  EXPECT_THAT(topic_findings(seen)[0].found, HasSubstr("domain 3).")) << "nobody is elsewhere";
  EXPECT_THAT(topic_findings(seen)[0].found, Not(HasSubstr("Processes")));
  seen.listening_domains = {3, 17};
  EXPECT_THAT(topic_findings(seen)[0].found,
              HasSubstr("domain 3). Processes of this host are in domain 17."));
}

TEST(Topics, AnotherPartition) {
  Observed seen = healthy();
  seen.endpoints[kDetections].partitions = {"car-7"};
  Findings found = topic_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("wrong_partition", "no_detections"));
  EXPECT_EQ(found[0].found,
            "\"perception\" (10.0.0.1) writes detections in the partition \"car-7\", not \"ego\".");
  seen.endpoints[kDetections].partitions = {};
  EXPECT_THAT(topic_findings(seen)[0].found, HasSubstr("in the default partition, not"));

  // Those of other vehicles are none of ours.
  seen.endpoints.push_back(detections_writer());
  EXPECT_THAT(ids(topic_findings(seen)), IsEmpty());
}

TEST(Topics, SimilarNames) {
  for (const char* name : {"laneloom/detections", "laneloom/v1/detections", "laneloom/v3/Detections",
                           "rt/laneloom/v3/detections", "/laneloom/v3/detections", "detections"}) {
    Observed seen = healthy();
    seen.endpoints[kDetections].topic = name;
    const Findings found = topic_findings(seen);
    ASSERT_THAT(ids(found), ElementsAre("similar_topic", "no_detections")) << name;
    EXPECT_THAT(found[0].found, HasSubstr(std::string("the topic ") + name + ", not laneloom/v3/detections"));
  }
  Observed seen = healthy();
  seen.endpoints[kPoses].topic = "rt/VehiclePose";
  EXPECT_THAT(ids(topic_findings(seen)), ElementsAre("similar_topic", "no_poses"));
  seen.endpoints[kPoses].topic = "laneloom/v3/gnss";
  EXPECT_THAT(ids(topic_findings(seen)), ElementsAre("no_poses"));
}

TEST(Topics, AnotherType) {
  Observed seen = healthy();
  seen.endpoints[kDetections].type = "my::Detections";
  const Findings found = topic_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("wrong_type", "no_detections"));
  EXPECT_THAT(found[0].found, HasSubstr("with the type my::Detections, not laneloom::msg::Detections"));
}

TEST(Topics, APlannerThatReadsWhatNobodyWrites) {
  Observed seen = healthy();
  seen.endpoints[kPlanner].partitions = {};
  ASSERT_THAT(ids(topic_findings(seen)), ElementsAre("wrong_partition"));
  EXPECT_THAT(topic_findings(seen)[0].found, HasSubstr("\"planner\" (10.0.0.1) reads the lane map in"));

  seen = healthy();
  seen.endpoints[kPlanner].topic = "rt/lane_map";
  EXPECT_THAT(ids(topic_findings(seen)), ElementsAre("similar_topic"));
  seen = healthy();
  seen.endpoints[kPlanner].type = "laneloom::msg::LaneMap2";
  EXPECT_THAT(ids(topic_findings(seen)), ElementsAre("wrong_type"));
}

TEST(Topics, APlannerOfAnotherVehicleIsWhereItBelongs) {
  Observed seen = healthy();
  seen.endpoints[kPlanner].partitions = {"car-2"};
  dds::Endpoint service = map_writer();
  service.partitions = {"car-2"};
  seen.endpoints.push_back(service);
  EXPECT_THAT(ids(topic_findings(seen)), IsEmpty());
}

}  // namespace
}  // namespace laneloom::doctor
