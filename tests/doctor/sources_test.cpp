#include "scenes.hpp"

namespace laneloom::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr dds::WriterId kOne{1}, kOther{2};

TEST(SourceFindings, WritersThatTakeTurnsAreNamed) {
  Observed seen = healthy();
  seen.endpoints[1].id = kOne;
  seen.endpoints.push_back(detections_writer());
  seen.endpoints.back().participant.name = "perception 2";
  seen.endpoints.back().id = kOther;
  EXPECT_THAT(source_findings(seen), IsEmpty()) << "each has a source of its own";
  seen.sources.at("camera").mixed = {kOne, kOther};
  const Findings found = source_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("source_of_several_writers"));
  EXPECT_EQ(found[0].found,
            "2 writers take turns with detections of one source, \"camera\": \"perception 2\" (10.0.0.1), "
            "\"perception\" (10.0.0.1).");
  EXPECT_THAT(found[0].remedy, HasSubstr("Detections.source"));
}

TEST(SourceFindings, MoreThanTheServiceKeepsApart) {
  Observed seen = healthy();
  std::vector<SourceStatus> sources;
  for (int i = 0; i < 8; ++i) sources.push_back({.source = "camera " + std::to_string(i), .frames = 3});
  seen.services[0].last.sources = sources;
  EXPECT_THAT(source_findings(seen), IsEmpty());
  sources.push_back({.source = "one more", .frames = 5});
  seen.services[0].last.sources = sources;
  const Findings found = source_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("too_many_sources"));
  EXPECT_EQ(found[0].found, "9 sources write detections; the service keeps 8 apart.");
  seen.services[0].first.sources = {sources.back()};
  EXPECT_THAT(source_findings(seen), IsEmpty()) << "one of them wrote before, and is silent";

  seen = healthy();
  seen.services.clear();
  for (int i = 0; i < 8; ++i) seen.sources[std::to_string(i)] = {.messages = 1};
  EXPECT_THAT(ids(source_findings(seen)), ElementsAre("too_many_sources")) << "no service is there to tell";
}

TEST(SourceFindings, SourcesThatDisagreeAreNamedWithHowMuch) {
  Observed seen = healthy();
  seen.services[0].last.sources = {
      {.source = "front"}, {.source = "side", .learned = {{"pitch_gain", 0.1}, {"beside_front", -1.75}}}};
  const Findings found = source_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("sources_disagree"));
  EXPECT_EQ(found[0].found,
            "The lines of source \"side\" lie 1.8 m to the right of those of source \"front\".");
}

TEST(SourceFindings, AFieldOfViewThatIsNeverGivenIsAdvisedAndNotWrong) {
  Observed seen = healthy();
  InputObserved& camera = seen.sources.at("camera");
  camera.without_view = camera.messages - 1;
  EXPECT_THAT(source_findings(seen), IsEmpty()) << "one had it";
  ++camera.without_view;
  const Findings found = source_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("no_field_of_view"));
  EXPECT_TRUE(found[0].advice);
}

TEST(SourceFindings, ASourceWhoseConfidencesAreAllDroppedIsAdvised) {
  Observed seen = healthy();
  ServiceStatus& status = seen.services[0].last;
  status.configuration = {{"mapper.preprocess.min_confidence", "0.3"}};
  status.counters.emplace_back("detections_unsure", 60);
  InputObserved& camera = seen.sources.at("camera");
  EXPECT_THAT(source_findings(seen), IsEmpty()) << "of no detection there is nothing to say";
  camera.best_confidence = 0.3;
  EXPECT_THAT(source_findings(seen), IsEmpty()) << "the surest is taken";
  camera.best_confidence = 0.28;
  const Findings found = source_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("detections_unsure"));
  EXPECT_EQ(
      found[0].found,
      "All detections of source \"camera\" are below mapper.preprocess.min_confidence = 0.3; the surest "
      "has 0.28.");
  EXPECT_THAT(found[0].remedy, HasSubstr("set mapper.preprocess.min_confidence to 0.140"));
  EXPECT_TRUE(found[0].advice);
  seen.services[0].first.counters = status.counters;
  EXPECT_THAT(source_findings(seen), IsEmpty()) << "the service knows the network, and drops nothing";
}

}  // namespace
}  // namespace laneloom::doctor
