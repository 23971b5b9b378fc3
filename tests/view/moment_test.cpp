#include "view/moment.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "drawing/small_map.hpp"
#include "view/events.hpp"
#include "view/frame_placer.hpp"
#include "view/frame_text.hpp"

namespace laneloom::view {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::IsEmpty;

PublishedMap published(std::uint64_t sequence, std::int64_t stamp_ns) {
  PublishedMap map;
  map.sequence = sequence;
  map.session_id = 1;
  map.state = MapState::ok;
  map.map = small_map();
  map.map.markings.clear();
  map.map.stamp_ns = stamp_ns;
  return map;
}
RoadMarkings markings_of(std::uint64_t sequence, std::uint64_t session_id = 1) {
  return {.sequence = sequence, .session_id = session_id, .markings = small_map().boundaries};
}

TEST(MomentBuilder, AMapIsCompleteWithItsMarkings) {
  MomentBuilder builder;
  EXPECT_FALSE(builder.add(DetectionFrame{.stamp_ns = 10}, 1));
  EXPECT_FALSE(builder.add(DetectionFrame{.stamp_ns = 20}, 2));
  EXPECT_FALSE(builder.add(published(7, 10), 3));
  EXPECT_FALSE(builder.add(markings_of(6), 4));
  EXPECT_FALSE(builder.add(markings_of(7, 2), 4));
  ASSERT_TRUE(builder.add(markings_of(7), 5));
  const ViewMoment moment = builder.take();
  EXPECT_EQ(moment.seen_ns, 3);
  EXPECT_EQ(moment.map.map.markings.size(), 2U);
  ASSERT_TRUE(moment.detections);
  EXPECT_EQ(moment.detections->stamp_ns, 10);
  EXPECT_FALSE(builder.finish());
}

TEST(MomentBuilder, AMapWhoseMarkingsAreLostComesWithTheNext) {
  MomentBuilder builder;
  EXPECT_FALSE(builder.add(published(7, 10), 3));
  ASSERT_TRUE(builder.add(published(8, 20), 4));
  EXPECT_EQ(builder.take().map.sequence, 7U);
  EXPECT_EQ(builder.finish()->map.sequence, 8U);
}

VehiclePose pose_at(double time_s, std::uint64_t session_id = 1) {
  return {.stamp_ns = static_cast<std::int64_t>(time_s * 1e9),
          .session_id = session_id,
          .position = {10.0 * time_s, 0.0, 0.0}};
}
/// A car that keeps 20 m ahead of the vehicle.
TrackedObjects objects_at(double time_s) {
  return {.stamp_ns = static_cast<std::int64_t>(time_s * 1e9),
          .session_id = 5,
          .objects = {{.id = 7,
                       .kind = ObjectKind::car,
                       .position = {20.0, 0.0, 0.0},
                       .heading = Point::UnitX(),
                       .speed_mps = 10.0,
                       .position_stddev_m = 0.3}}};
}

/// Takes poses and objects of each tenth of a second of [from_s, to_s), and the map then. Returns its moment.
ViewMoment drive(MomentBuilder& builder, int from, int to) {
  for (int i = from; i < to; ++i) {
    builder.add(pose_at(0.1 * i), i);
    builder.add(objects_at(0.1 * i), i);
  }
  builder.add(published(static_cast<std::uint64_t>(to), pose_at(0.1 * (to - 1)).stamp_ns), to);
  return *builder.finish();
}

TEST(MomentBuilder, KeepsTheOtherVehiclesAndTheirTrails) {
  MomentBuilder builder;
  EXPECT_FALSE(builder.add(objects_at(0.1), 1)) << "no pose is known yet";
  const Traffic first = drive(builder, 1, 2).traffic;
  ASSERT_EQ(first.seen.size(), 1U);
  EXPECT_EQ(first.seen[0].objects.objects.at(0).id, 7U);
  const Traffic later = drive(builder, 2, 21).traffic;
  ASSERT_EQ(later.seen.size(), 1U);
  EXPECT_NEAR(later.seen[0].T_map_body.translation().x(), 20.0, 1e-6);
  ASSERT_EQ(later.trails.size(), 1U);
  EXPECT_NEAR(later.trails[0].points.front().x(), 21.0, 1e-6);
  EXPECT_NEAR(later.trails[0].points.back().x(), 40.0, 1.0);
}

TEST(MomentBuilder, OtherVehiclesAreGoneWhenTheirTrackerIsSilentAndInAnotherSessionOfPoses) {
  MomentBuilder builder;
  EXPECT_EQ(drive(builder, 1, 11).traffic.seen.size(), 1U);
  for (int i = 11; i < 30; ++i) builder.add(pose_at(0.1 * i), i);
  builder.add(published(30, pose_at(2.9).stamp_ns), 30);
  const Traffic silent = builder.finish()->traffic;
  EXPECT_THAT(silent.seen, IsEmpty());
  EXPECT_EQ(silent.trails.size(), 1U) << "the trail is still known";
  builder.add(pose_at(3.0, 2), 31);
  builder.add(published(31, pose_at(3.0).stamp_ns), 31);
  EXPECT_THAT(builder.finish()->traffic.trails, IsEmpty());
}

/// The texts of the events between two moments.
std::vector<std::string> events_between(const ViewMoment& before, const ViewMoment& after) {
  EventFinder finder;
  EXPECT_THAT(finder.next(before, nullptr), IsEmpty());
  std::vector<std::string> texts;
  for (const ViewEvent& event : finder.next(after, nullptr)) texts.push_back(event.kind + ": " + event.text);
  return texts;
}

TEST(EventFinder, FindsWhatChanged) {
  const ViewMoment before{.map = published(1, 10), .status = ServiceStatus{.sequence = 1}};
  EXPECT_THAT(events_between(before, before), IsEmpty());
  ViewMoment gone = before;
  gone.alive = false;
  EXPECT_THAT(events_between(before, gone), Contains("service: the service is gone or hangs"));
  ViewMoment other = before;
  other.map.session_id = 2;
  other.map.map_id = 3;
  EXPECT_THAT(events_between(before, other), Contains("service: another session of the service: 2"));
  EXPECT_THAT(events_between(before, other), Contains("reset: a new map: earlier ids are void"));
  ViewMoment refusing = before;
  refusing.status->sequence = 2;
  refusing.status->counters = {{"detections_refused_late", 4}, {"detections_fused", 9}};
  EXPECT_THAT(events_between(before, refusing), testing::ElementsAre("counter: detections refused late +4"));
  ViewMoment degraded = before;
  degraded.map.state = MapState::degraded;
  EXPECT_EQ(events_between(before, degraded).size(), 1U);
}

/// A moment with the vehicle beside the lane (`aside_m`), or in it, on a straight way.
ViewMoment moment_at(double time_s, double aside_m, double way_m = 0.0) {
  ViewMoment moment{.map = published(1, static_cast<std::int64_t>(time_s * 1e9))};
  moment.seen_ns = moment.map.map.stamp_ns;
  moment.map.map.lineage.clear();
  moment.map.map.T_map_body.translate(Point(-12.0, aside_m, 0.0));
  for (Lane& lane : moment.map.map.lanes) {
    lane.direction = Lane::Direction::along_centerline;
    lane.centerline = {{-20, way_m, 0}, {30, way_m, 0}};
  }
  moment.map.map.lanes.pop_back();
  return moment;
}

TEST(FramePlacer, TellsWhatADriverWouldNotice) {
  FramePlacer placer(RangeConfig{});
  placer.next(moment_at(0.0, 0.0));
  const FramePlace in_lane = placer.next(moment_at(3.0, 0.0));
  ASSERT_EQ(in_lane.quality.size(), 1U);
  EXPECT_EQ(in_lane.quality[0].own_lane, 21U);
  EXPECT_THAT(in_lane.events, IsEmpty());
  const FramePlace jumped = placer.next(moment_at(3.1, 0.0, 0.4));
  EXPECT_NEAR(jumped.quality[0].jump_m.value(), 0.4, 1e-9);
  ASSERT_EQ(jumped.events.size(), 1U);
  EXPECT_EQ(jumped.events[0].text, "the way jumps 0.40 m, 10 m ahead");
  const FramePlace lost = placer.next(moment_at(3.2, 5.0, 0.4));
  EXPECT_EQ(lost.quality[0].own_lane, kNoElement);
  ASSERT_EQ(lost.events.size(), 1U);
  EXPECT_EQ(lost.events[0].text, "own lane 21 is lost");
  const FramePlace found = placer.next(moment_at(3.7, 0.4, 0.4));
  ASSERT_FALSE(found.events.empty());
  EXPECT_EQ(found.events[0].text, "own lane 21 after 0.5 s without");
  EXPECT_EQ(found.number, 4U);
}

TEST(FramePlacer, AMapThatIsRepeatedHasNoFigures) {
  FramePlacer placer(RangeConfig{});
  ViewMoment moment = moment_at(3.0, 0.0);
  moment.map.age_s = 0.1;
  EXPECT_TRUE(json::parse(summary_text(moment, placer.next(moment))).contains("age_s"));
  moment.alive = false;
  moment.repeated = true;
  moment.seen_ns += 500'000'000;
  const json summary = json::parse(summary_text(moment, placer.next(moment)));
  EXPECT_EQ(summary["time_s"], 3.5);
  EXPECT_EQ(summary["repeated"], true);
  EXPECT_FALSE(summary.contains("age_s"));
  EXPECT_FALSE(summary.contains("quality"));
  EXPECT_EQ(summary["events"][0][0], "service");
}

TEST(FrameText, HasSummaryElementsAndWhatIsCompared) {
  ViewMoment moment{.map = published(5, 10'000'000'000),
                    .seen_ns = 1'500'000'000,
                    .status = ServiceStatus{.counters = {{"detections_refused_late", 4}}}};
  moment.map.published_ns = moment.seen_ns - 2'000'000;
  moment.others = {small_map(), {}};
  moment.traffic = {.seen = {{.objects = objects_at(1.0)}},
                    .trails = {{.session = 5, .object = 7, .points = {{0, 0, 0}, {9, 0, 0}}}}};
  const FramePlace place{3, {}, {{"reset", "a new map"}}};
  const json frame = json::parse(frame_text(moment, place, RangeConfig{}));
  EXPECT_EQ(frame["number"], 3);
  EXPECT_EQ(frame["time_s"], 1.5);
  EXPECT_EQ(frame["state"], "OK");
  EXPECT_EQ(frame["latency_ms"], 2.0);
  EXPECT_EQ(frame["refused"], 4);
  EXPECT_EQ(frame["age_s"], json());  // not known
  EXPECT_EQ(frame["events"], json::parse(R"([["reset", "a new map"]])"));
  EXPECT_EQ(frame["lineage"][0]["kind"], "merged_into");
  const auto is_lane = [](const json& element) { return element["key"] == "lanes/21"; };
  EXPECT_TRUE(std::any_of(frame["elements"].begin(), frame["elements"].end(), is_lane));
  for (const char* key : {"traffic/5/object/7", "traffic/5/trail/7/0"})
    EXPECT_TRUE(std::ranges::any_of(frame["elements"], [&](const json& e) { return e["key"] == key; }))
        << key;
  ASSERT_EQ(frame["others"].size(), 2U);
  const json& first = frame["others"][0]["elements"];
  EXPECT_TRUE(std::any_of(first.begin(), first.end(), is_lane));
  const json& second = frame["others"][1]["elements"];
  EXPECT_FALSE(std::any_of(second.begin(), second.end(), is_lane));
  // The summary is the same without what is drawn.
  json summary = json::parse(summary_text(moment, place));
  for (const auto& [key, value] : summary.items()) EXPECT_EQ(frame[key], value) << key;
  EXPECT_FALSE(summary.contains("elements"));
}

}  // namespace
}  // namespace laneloom::view
