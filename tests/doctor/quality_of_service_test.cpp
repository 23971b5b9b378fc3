#include <functional>

#include "scenes.hpp"

namespace laneloom::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The findings when the planner's reader is changed.
Findings with_planner(const std::function<void(dds::Endpoint&)>& change) {
  Observed seen = healthy();
  change(seen.endpoints[3]);
  return qos_findings(seen);
}

TEST(QualityOfService, WhatIsOfferedIsEnough) {
  EXPECT_THAT(with_planner([](dds::Endpoint& reader) { reader = map_reader(); }), IsEmpty());
  EXPECT_THAT(with_planner([](dds::Endpoint& reader) {
                reader = map_writer();  // exactly what is offered
                reader.is_writer = false;
              }),
              IsEmpty());
}

TEST(QualityOfService, EachPolicyIsNamedWithBothSides) {
  const auto text_of = [](const std::function<void(dds::Endpoint&)>& change) {
    const Findings found = with_planner(change);
    EXPECT_THAT(ids(found), ElementsAre("qos_mismatch"));
    return found.empty() ? std::string() : found[0].found;
  };
  EXPECT_EQ(text_of([](dds::Endpoint& reader) { reader.deadline_s = 0.1; }),
            "\"laneloomd\" (10.0.0.1) writes laneloom/v3/lane_map, but \"planner\" (10.0.0.1) can't read it: "
            "deadline (offered: 0.25 s, requested: 0.1 s).");
  EXPECT_THAT(text_of([](dds::Endpoint& reader) { reader.durability = dds::Durability::persistent; }),
              HasSubstr("durability (offered: transient local, requested: persistent)"));
  EXPECT_THAT(text_of([](dds::Endpoint& reader) { reader.lease_s = 0.3; }),
              HasSubstr("liveliness lease (offered: 0.4 s, requested: 0.3 s)"));
  EXPECT_THAT(text_of([](dds::Endpoint& reader) { reader.exclusive = true; }),
              HasSubstr("ownership (offered: shared, requested: exclusive)"));
}

TEST(QualityOfService, AReaderThatAsksForMoreThanTheWriterOffers) {
  Observed seen = healthy();
  seen.endpoints[4].reliable = true;  // as if the service read detections so
  seen.endpoints[4].liveliness = dds::Liveliness::manual_by_topic;
  seen.endpoints[4].deadline_s = 1.0;
  const Findings found = qos_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("qos_mismatch"));
  EXPECT_THAT(found[0].found, HasSubstr("reliability (offered: best effort, requested: reliable), "
                                        "deadline (offered: infinite, requested: 1 s), "
                                        "liveliness (offered: automatic, requested: manual by topic)."));
}

TEST(QualityOfService, OnlyOfPairsThatWouldMatchOtherwise) {
  EXPECT_THAT(with_planner([](dds::Endpoint& reader) {
                reader.deadline_s = 0.1;
                reader.partitions = {"other"};
              }),
              IsEmpty());
  EXPECT_THAT(with_planner([](dds::Endpoint& reader) {
                reader.deadline_s = 0.1;
                reader.type = "other";
              }),
              IsEmpty());
  Observed seen = healthy();
  for (auto& each : seen.endpoints) each.partitions = {"other"};
  seen.endpoints[3].deadline_s = 0.1;
  EXPECT_THAT(qos_findings(seen), IsEmpty()) << "another vehicle's";
}

}  // namespace
}  // namespace laneloom::doctor
