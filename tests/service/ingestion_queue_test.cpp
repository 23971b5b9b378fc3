#include "service/ingestion_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace laneloom::service {
namespace {

Config capacities(int frames, int poses) {
  Config config;
  config.sync.queue_capacity = frames;
  config.sync.pose_queue_capacity = poses;
  return config;
}

DetectionFrame frame(std::uint64_t sequence) { return {.stamp_ns = 1, .sequence = sequence}; }
VehiclePose pose(std::uint64_t sequence) { return {.stamp_ns = 1, .sequence = sequence}; }
TrackedObjects objects(std::uint64_t sequence) { return {.stamp_ns = 1, .sequence = sequence}; }

/// A valid frame of so many equal detections.
DetectionFrame frame_of(std::size_t detections) {
  DetectionFrame result = frame(1);
  result.detections.resize(detections, {.confidence = 0.5, .points = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}});
  return result;
}

/// "f1 p2": the kinds and sequences, in order.
std::string text(const std::vector<core::Arrival>& arrivals) {
  std::string result;
  for (const auto& [message, arrival_ns] : arrivals) {
    if (!result.empty()) result += " ";
    if (const auto* f = std::get_if<DetectionFrame>(&message)) {
      result += "f" + std::to_string(f->sequence);
    } else if (const auto* o = std::get_if<TrackedObjects>(&message)) {
      result += "o" + std::to_string(o->sequence);
    } else if (const auto* t = std::get_if<NextTurn>(&message)) {
      result += "t" + std::to_string(t->sequence);
    } else {
      result += "p" + std::to_string(std::get<VehiclePose>(message).sequence);
    }
  }
  return result;
}

TEST(IngestionQueue, KeepsTheOrderOfArrivalAcrossKinds) {
  IngestionQueue queue(capacities(8, 8));
  queue.push(frame(1), 10);
  queue.push(pose(2), 10);
  queue.push(pose(3), 11);
  queue.push(frame(4), 11);
  queue.push(pose(5), 12);
  const auto arrivals = queue.take().messages;
  EXPECT_EQ(text(arrivals), "f1 p2 p3 f4 p5");
  EXPECT_EQ(arrivals[3].arrival_ns, 11);
  EXPECT_TRUE(queue.take().messages.empty());
}

TEST(IngestionQueue, TellsWhenFramesCanBeFused) {
  int told = 0;
  IngestionQueue queue(capacities(8, 8), [&] { ++told; });
  queue.push(frame(1), 10);
  EXPECT_EQ(told, 0) << "its pose is not there";
  queue.push(pose(1), 11);
  queue.push(frame(2), 12);
  queue.push(pose(2), 13);
  EXPECT_EQ(told, 2);
  EXPECT_EQ(queue.take_ready(), (std::vector<std::int64_t>{11, 12}));
  EXPECT_TRUE(queue.take_ready().empty());
}

TEST(IngestionQueue, AFloodThatNobodyTakesIsBounded) {
  IngestionQueue queue(capacities(4, 4));
  queue.push(pose(1), 0);
  for (std::uint64_t i = 0; i < 100; ++i) queue.push(frame(i), 1);
  EXPECT_EQ(queue.take_ready().size(), 4U);
}

TEST(IngestionQueue, KeepsObjectsInTheOrderOfArrivalWithinTheirBound) {
  IngestionQueue queue(capacities(2, 8));
  queue.push(pose(1), 0);
  for (std::uint64_t i = 2; i < 5; ++i) queue.push(objects(i), 0);
  queue.push(frame(5), 0);
  queue.push(TrackedObjects{.stamp_ns = -1}, 0);
  queue.refuse(Input::objects, "malformed", 0);
  queue.number(Input::objects, {3}, 1);
  queue.number(Input::objects, {3}, 4);
  const auto before = queue.take();
  EXPECT_EQ(text(before.messages), "p1 o3 o4 f5");
  EXPECT_EQ(before.counters["objects_received"], 5U);
  EXPECT_EQ(before.counters["objects_dropped_queue_full"], 1U);
  EXPECT_EQ(before.counters["objects_refused_stamp"], 1U);
  EXPECT_EQ(before.counters["objects_refused_malformed"], 1U);
  queue.push(objects(6), 0);
  EXPECT_EQ(queue.take().counters["objects_lost"], 2U) << "with the message that shows the loss";
}

TEST(IngestionQueue, KeepsTurnsApartFromObjects) {
  IngestionQueue queue(capacities(2, 8));
  for (std::uint64_t i = 1; i < 4; ++i) queue.push(NextTurn{.stamp_ns = 1, .sequence = i}, 0);
  queue.push(objects(4), 0);
  queue.push(NextTurn{.stamp_ns = 1, .distance_m = -1.0}, 0);
  queue.number(Input::objects, {3}, 1);
  queue.number(Input::next_turns, {3}, 9);
  const auto arrivals = queue.take();
  EXPECT_EQ(text(arrivals.messages), "t2 t3 o4");
  EXPECT_EQ(arrivals.counters["next_turns_received"], 4U);
  EXPECT_EQ(arrivals.counters["next_turns_dropped_queue_full"], 1U);
  EXPECT_EQ(arrivals.counters["next_turns_refused_distance"], 1U);
  EXPECT_EQ(arrivals.counters["next_turns_lost"], 0U) << "each has numbers of its own";
}

TEST(IngestionQueue, DropsTheOldestOfAKindAndCountsIt) {
  IngestionQueue queue(capacities(2, 3));
  for (std::uint64_t i = 0; i < 5; ++i) {
    queue.push(frame(i), 0);
    queue.push(pose(i), 0);
  }
  const auto arrivals = queue.take();
  const auto& counters = arrivals.counters;
  EXPECT_EQ(text(arrivals.messages), "p2 f3 p3 f4 p4");
  EXPECT_EQ(counters["detections_received"], 5U);
  EXPECT_EQ(counters["poses_received"], 5U);
  EXPECT_EQ(counters["frames_dropped_queue_full"], 3U);
  EXPECT_EQ(counters["poses_dropped_queue_full"], 2U);
}

TEST(IngestionQueue, AFloodOfOneSourceLeavesTheFramesOfAnother) {
  IngestionQueue queue(capacities(4, 4));
  auto quiet = frame(1);
  quiet.source = "quiet";
  queue.push(std::move(quiet), 0);
  for (std::uint64_t i = 10; i < 30; ++i) queue.push(frame(i), 0);
  EXPECT_EQ(text(queue.take().messages), "f1 f27 f28 f29");
}

TEST(IngestionQueue, ThinsAFrameThatIsTooMuchWork) {
  auto config = capacities(4, 4);
  config.gate.max_frame_detections = 2;
  IngestionQueue queue(config);
  queue.push(frame_of(5), 0);
  const auto arrivals = queue.take();
  EXPECT_EQ(arrivals.counters["frames_thinned"], 1U);
  EXPECT_EQ(arrivals.counters["detections_left_out"], 3U);
  EXPECT_EQ(std::get<DetectionFrame>(arrivals.messages[0].message).detections.size(), 2U);
}

TEST(IngestionQueue, RefusesAFrameWholeForADefectInWhatWouldBeLeftOut) {
  auto config = capacities(4, 4);
  config.gate.max_frame_detections = 2;
  IngestionQueue queue(config);
  auto heavy = frame_of(5);
  heavy.detections[4].confidence = 0.1;
  heavy.detections[4].points[1].x() = 1e300;
  queue.push(std::move(heavy), 7);
  const auto arrivals = queue.take();
  EXPECT_EQ(arrivals.counters["detections_received"], 1U);
  EXPECT_EQ(arrivals.counters["detections_refused_coordinate"], 1U);
  EXPECT_EQ(arrivals.counters["frames_thinned"], 0U);
  EXPECT_EQ(arrivals.newest_frame_ns, 7) << "detections do come";
  EXPECT_TRUE(arrivals.messages.empty());
}

TEST(IngestionQueue, CountsWhatIsRefusedByReason) {
  IngestionQueue queue(capacities(2, 2));
  queue.refuse(Input::detections, "malformed", 3);
  queue.refuse(Input::detections, "malformed", 5);
  queue.refuse(Input::poses, "wrong_frame", 4);
  const auto arrivals = queue.take();
  const auto& counters = arrivals.counters;
  EXPECT_EQ(counters["detections_received"], 2U);
  EXPECT_EQ(counters["detections_refused_malformed"], 2U);
  EXPECT_EQ(counters["poses_received"], 1U);
  EXPECT_EQ(counters["poses_refused_wrong_frame"], 1U);
  EXPECT_EQ(arrivals.newest_frame_ns, 5) << "it has arrived";
  EXPECT_EQ(arrivals.newest_pose_ns, 4);
}

TEST(IngestionQueue, KnowsTheSessionsOfEachSource) {
  IngestionQueue queue(capacities(2, 2));
  const auto push = [&](const std::string& source, std::uint64_t session, std::uint64_t sequence) {
    auto of_source = frame(sequence);
    of_source.source = source;
    of_source.session_id = session;
    queue.push(std::move(of_source), 0);
  };
  for (const std::uint64_t sequence : {6U, 5U, 9U, 8U}) push("front", 1, sequence);
  push("front", 2, 0);
  push("rear", 1, 3);
  const auto sources = queue.take().sources;
  ASSERT_EQ(sources.size(), 3U);
  EXPECT_EQ(sources[0].first_sequence, 5U);
  EXPECT_EQ(sources[0].last_sequence, 9U);
  EXPECT_EQ(sources[0].frames, 4U);
  EXPECT_EQ(sources[1].session_id, 2U);
  EXPECT_EQ(sources[2].source, "rear");
  auto refused = frame_of(1);
  refused.source = "rear";
  refused.session_id = 1;
  refused.detections[0].confidence = 2.0;
  queue.push(std::move(refused), 0);
  EXPECT_EQ(queue.take().sources[2].frames, 2U) << "a refused one has arrived, too";

  for (std::uint64_t session = 10; session < 30; ++session) push("front", session, 0);
  ASSERT_EQ(queue.take().sources.size(), 16U);
  EXPECT_EQ(queue.take().sources.front().session_id, 14U);
}

TEST(IngestionQueue, KeepsTheSourcesThatWereHeardLast) {
  IngestionQueue queue(capacities(2, 2));
  const auto push = [&](const std::string& source, std::uint64_t session, std::int64_t arrival_ns) {
    auto of_source = frame(1);
    of_source.source = source;
    of_source.session_id = session;
    queue.push(std::move(of_source), arrival_ns);
  };
  push("silent", 1, 0);
  push("steady", 1, 1);
  for (std::uint64_t session = 10; session < 50; ++session) {
    push("restarts", session, static_cast<std::int64_t>(2 * session));
    push("steady", 1, static_cast<std::int64_t>(2 * session + 1));
  }
  const auto sources = queue.take().sources;
  ASSERT_EQ(sources.size(), 16U);
  EXPECT_EQ(sources.front().source, "steady");
  EXPECT_EQ(sources.front().frames, 41U);
  EXPECT_EQ(sources[1].session_id, 35U) << "of the one that restarts, the newest 15 are left";
}

TEST(IngestionQueue, CountsWhatNeverCame) {
  IngestionQueue queue(capacities(2, 2));
  queue.number(Input::detections, {1}, 7);
  queue.number(Input::detections, {1}, 11);
  for (const std::uint64_t number : {1U, 6U, 8U}) queue.number(Input::poses, {2}, number);
  EXPECT_EQ(queue.take().counters["detections_lost"], 0U) << "before the message that shows it";
  queue.refuse(Input::detections, "malformed", 1);
  queue.push(pose(8), 0);
  const auto counters = queue.take().counters;
  EXPECT_EQ(counters["detections_lost"], 3U);
  EXPECT_EQ(counters["poses_lost"], 5U);
  EXPECT_EQ(counters["detections_received"], 1U);
}

TEST(IngestionQueue, CountsExactlyWhileThreadsPush) {
  IngestionQueue queue(capacities(16, 16));
  constexpr std::uint64_t kEach = 5000;
  std::atomic<int> running = 3;
  const auto pushing = [&] {
    for (std::uint64_t i = 0; i < kEach; ++i) {
      queue.push(frame(i), 1);
      if (i % 3 == 0) queue.refuse(Input::detections, "malformed", 1);
    }
    --running;
  };
  std::vector<std::jthread> threads;
  for (int i = 0; i < 3; ++i) threads.emplace_back(pushing);
  std::uint64_t taken = 0;
  const auto balanced = [&] {
    const auto now = queue.take();
    taken += now.messages.size();
    return now.counters["detections_received"] ==
           now.counters["detections_refused_malformed"] + now.counters["frames_dropped_queue_full"] + taken;
  };
  while (running > 0) ASSERT_TRUE(balanced());
  EXPECT_TRUE(balanced());
  EXPECT_EQ(queue.take().counters["detections_received"], 3 * (kEach + (kEach + 2) / 3));
}

}  // namespace
}  // namespace laneloom::service
