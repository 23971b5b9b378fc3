#include "scenes.hpp"

namespace laneloom::doctor {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Presence, NothingIsWrongWhenAllAreThere) { EXPECT_THAT(ids(findings(healthy())), IsEmpty()); }

TEST(Presence, AnEmptyDomainIsToldWithThoseThatAreNot) {
  Observed seen;
  seen.dds.domain = 3;
  seen.listening_domains = {0, 3, 17};
  const Findings found = findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("empty_domain")) << "of those who are not there no more is said";
  EXPECT_THAT(found[0].found,
              HasSubstr("Nobody else is in domain 3. Processes of this host are in domain 0, 17."));
  seen.listening_domains = {3};
  EXPECT_EQ(findings(seen)[0].found, "Nobody else is in domain 3.");
}

TEST(Presence, NoServiceAtAll) {
  Observed seen = healthy();
  std::erase_if(seen.endpoints, [](const auto& each) { return each.participant.name == "laneloomd"; });
  const Findings found = presence_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("no_service"));
  EXPECT_EQ(found[0].found, "No service publishes maps for vehicle \"ego\" in domain 3.");
  EXPECT_THAT(found[0].remedy, HasSubstr("Start laneloomd"));
  seen.listening_domains = {0, 3};
  EXPECT_THAT(presence_findings(seen)[0].found, HasSubstr("Processes of this host are in domain 0."));
}

TEST(Presence, AServiceThatIsStoppedOrDeafIsNotAbsent) {
  Observed seen = healthy();
  std::erase_if(seen.endpoints, [](const auto& each) { return each.participant.name == "laneloomd"; });
  seen.service_processes = {{.id = 7, .stopped = false}};
  Findings found = presence_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("service_unheard"));
  EXPECT_THAT(found[0].found, HasSubstr("process 7"));
  EXPECT_THAT(found[0].remedy, HasSubstr("restart"));
  seen.service_processes.push_back({.id = 8, .stopped = true});
  found = presence_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("service_stopped"));
  EXPECT_THAT(found[0].remedy, HasSubstr("kill -CONT 8"));
  seen.participants.clear();
  EXPECT_THAT(ids(presence_findings(seen)), ElementsAre("service_stopped", "empty_domain"));
}

TEST(Presence, AServiceThatWasHeardAndIsStopped) {
  Observed seen = healthy();
  seen.services.clear();
  EXPECT_THAT(ids(state_findings(seen)), ElementsAre("service_silent"));
  seen.service_processes = {{.id = 8, .stopped = true}};
  EXPECT_THAT(ids(state_findings(seen)), ElementsAre("service_stopped"));
}

TEST(Presence, ServicesOfOtherVehicles) {
  Observed seen = healthy();
  seen.endpoints[0].partitions = {"car-1"};
  dds::Endpoint other = map_writer();
  other.partitions = {"car-2"};
  seen.endpoints.push_back(other);
  const Findings found = presence_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("no_service"));
  EXPECT_THAT(found[0].found, HasSubstr("services in the partition \"car-1\", in the partition \"car-2\""));
  EXPECT_THAT(found[0].remedy, HasSubstr("--vehicle-id"));
}

TEST(Presence, TwoServicesOfOneVehicleAreNamed) {
  Observed seen = healthy();
  dds::Endpoint other = map_writer();
  other.participant = {"01.0f", "", "10.0.0.2"};
  seen.endpoints.push_back(other);
  const Findings found = presence_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("two_services"));
  EXPECT_THAT(found[0].found, HasSubstr("\"laneloomd\" (10.0.0.1), 01.0f (10.0.0.2)"));
}

TEST(Presence, AWildcardPartitionIsOfEveryVehicle) {
  Observed seen = healthy();
  for (auto& each : seen.endpoints) each.partitions = {"other", "e*"};
  EXPECT_THAT(ids(findings(seen)), IsEmpty());
}

}  // namespace
}  // namespace laneloom::doctor
