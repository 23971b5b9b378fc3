#include <fstream>
#include <regex>

#include "dds/rtps_guard.hpp"
#include "doctor/refusals.hpp"
#include "scenes.hpp"

namespace laneloom::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;

TEST(HealthFindings, TheStatesReasons) {
  Observed seen = healthy();
  seen.services[0].last.state = MapState::stale;
  seen.services[0].last.reasons = {StateReason::no_poses, StateReason::overloaded};
  const Findings found = state_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("state_no_poses", "state_overloaded"));
  EXPECT_EQ(found[0].found, "The service says STALE: no_poses.");
}

// A service says it as well when it refuses every frame for what is in it.
TEST(HealthFindings, FramesThatAreNotFusedAreNotBlamedOnPosesAlone) {
  Observed seen = healthy();
  seen.services[0].last.state = MapState::stale;
  seen.services[0].last.reasons = {StateReason::unsynchronised};
  seen.services[0].last.counters = {{"detections_refused_stddev", 20}};
  const Findings found = state_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("state_unsynchronised"));
  EXPECT_THAT(ids(incident_findings(seen)), ElementsAre("detections_refused_stddev"));
  EXPECT_THAT(ids(findings(seen)), ElementsAre("detections_refused_stddev", "state_unsynchronised"))
      << "the cause first";
  EXPECT_THAT(found[0].why, HasSubstr("or for another reason"));
  EXPECT_THAT(found[0].remedy, HasSubstr("detections_refused_<reason>"));
}

TEST(HealthFindings, WhatTwoServicesSayAlikeIsToldOnce) {
  Observed seen = healthy();
  seen.services[0].last.reasons = {StateReason::another_service};
  seen.services.push_back(seen.services[0]);
  EXPECT_THAT(ids(findings(seen)), ElementsAre("state_another_service"));
}

TEST(HealthFindings, CountersThatRise) {
  Observed seen = healthy();
  seen.services[0].last.counters = {{"frames_fused", 20},
                                    {"poses_lost", 4},
                                    {"detections_refused_late", 3},
                                    {"poses_refused_wrong_frame", 7}};
  const Findings found = incident_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("poses_lost", "poses_refused_wrong_frame"));
  EXPECT_EQ(found[0].found, "poses_lost: poses were lost on the way (2 more).");
  EXPECT_EQ(found[1].found,
            "The service refused 7 poses (wrong_frame): their frame_id is not the map frame.");
  EXPECT_THAT(found[1].remedy, HasSubstr("dds.map_frame_id"));
}

TEST(HealthFindings, ObjectsThatLeaveNoTrail) {
  Observed seen = healthy();
  auto& counters = seen.services[0].last.counters;
  counters = {{"objects_without_heading", 30}, {"objects_doubted", 5}};
  const Findings found = incident_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("objects_leave_no_trail"));
  EXPECT_THAT(found[0].found, HasSubstr("Of 35 moving objects, 30 have no heading, and 5 are"));
  EXPECT_TRUE(found[0].advice);
  counters.emplace_back("objects_believed", 1);
  EXPECT_THAT(incident_findings(seen), IsEmpty());
}

TEST(HealthFindings, DatagramsThatAreRefusedAtTheDoor) {
  Observed seen = healthy();
  seen.services[0].last.counters = {{"datagrams_refused_leap", 5}};
  const Findings found = incident_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("datagrams_refused_leap"));
  EXPECT_EQ(found[0].found,
            "The service refused 5 datagrams (leap): sequence numbers are far beyond those that the writer "
            "has sent.");
  for (const auto reason : dds::kDatagramRefusals)
    EXPECT_NE(explain_refused_datagrams(reason).cause, explain_refused_datagrams("unknown").cause) << reason;
}

// Counters come in the order of the alphabet.
TEST(HealthFindings, CausesStandBeforeTheirConsequences) {
  Observed seen = healthy();
  seen.services[0].last.counters = {{"detections_refused_unsynchronised", 20},
                                    {"frames_dropped_queue_full", 1},
                                    {"poses_refused_wrong_frame", 90}};
  seen.services[0].first.sources = {{.source = "front", .session_id = 1}};
  seen.services[0].last.sources = {{.source = "front", .session_id = 1, .frames = 20}};
  EXPECT_THAT(ids(incident_findings(seen)),
              ElementsAre("frames_dropped_queue_full", "poses_refused_wrong_frame",
                          "detections_refused_unsynchronised", "source_not_fused"));
}

/// The reasons of the table under "### Refusals" of deploy/README.md.
std::vector<std::string> reasons_of_the_page() {
  std::ifstream page(DEPLOYMENT_PAGE);
  std::vector<std::string> reasons;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) inside = line == "### Refusals";
    if (!inside || !line.starts_with("| `")) continue;
    const std::string cell = line.substr(0, line.find(" | "));
    static const std::regex kName("`([a-z_]+)`");
    for (auto at = std::sregex_iterator(cell.begin(), cell.end(), kName); at != std::sregex_iterator(); ++at)
      reasons.push_back((*at)[1]);
  }
  return reasons;
}

TEST(HealthFindings, EveryReasonThatThePageOfDeploymentListsIsExplained) {
  const std::vector<std::string> reasons = reasons_of_the_page();
  EXPECT_THAT(reasons, IsSupersetOf({"malformed", "too_few_points", "repeated_id", "contradictory"}));
  for (const char* subject : {"detections", "poses", "objects"}) {
    const std::string unknown(explain_refusal(subject, "no such reason").cause);
    for (const std::string& reason : reasons)
      EXPECT_NE(explain_refusal(subject, reason).cause, unknown) << reason;
  }
}

TEST(HealthFindings, AFrameIsWrongForAReasonOfItsTopic) {
  const auto cause = [](const char* subject) { return explain_refusal(subject, "wrong_frame").cause; };
  EXPECT_THAT(cause("detections"), HasSubstr("is the map frame"));
  EXPECT_THAT(cause("poses"), HasSubstr("is not the map frame"));
  EXPECT_THAT(cause("objects"), HasSubstr("base_link"));
}

TEST(HealthFindings, ASourceOfWhichNothingIsMapped) {
  Observed seen = healthy();
  const auto sources = [](std::uint64_t front_fused, std::uint64_t rear_fused, std::uint64_t frames) {
    SourceStatus front{.source = "front", .session_id = 1, .frames = frames, .fused = front_fused};
    SourceStatus rear{.source = "rear", .session_id = 2, .frames = frames, .fused = rear_fused};
    return std::vector{front, rear};
  };
  seen.services[0].first.sources = sources(10, 0, 10);
  seen.services[0].last.sources = sources(30, 0, 30);
  const Findings found = incident_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("source_not_fused"));
  EXPECT_EQ(found[0].found, "Of source \"rear\", 20 frames arrived and none was mapped.");
  seen.services[0].last.sources = sources(30, 1, 30);
  EXPECT_THAT(incident_findings(seen), IsEmpty());
}

TEST(HealthFindings, AServiceThatIsNotHeard) {
  Observed seen = healthy();
  seen.services.clear();
  const Findings found = state_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("service_silent"));
  EXPECT_EQ(found[0].found,
            "\"laneloomd\" (10.0.0.1) publishes maps, but no status of it came within 3.0 s.");
}

TEST(HealthFindings, WhatAServiceWouldRefuse) {
  Observed seen = healthy();
  seen.poses.refused = {{"wrong_frame", 5}};
  EXPECT_THAT(incident_findings(seen), IsEmpty()) << "the service knows better";
  seen.services.clear();
  seen.endpoints.erase(seen.endpoints.begin());
  EXPECT_THAT(ids(incident_findings(seen)), ElementsAre("poses_refused_wrong_frame"));
}

}  // namespace
}  // namespace laneloom::doctor
