#include "replay/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <utility>

#include "io/json_lines.hpp"
#include "laneloom/dds/cdr.hpp"
#include "milliseconds.hpp"
#include "replay/message_source.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::replay {
namespace {

VehiclePose pose_at(std::int64_t stamp_ms) {
  return {.stamp_ns = stamp_ms * kMs,
          .sequence = static_cast<std::uint64_t>(stamp_ms),
          .session_id = 1,
          .position = {0.01 * static_cast<double>(stamp_ms), 0.0, 0.0}};
}

DetectionFrame frame_at(std::int64_t stamp_ms) {
  DetectionFrame frame{.stamp_ns = stamp_ms * kMs,
                       .sequence = static_cast<std::uint64_t>(stamp_ms),
                       .session_id = 1,
                       .source = "test"};
  const double wobble_m = 0.03 * static_cast<double>(stamp_ms / 100 % 5);
  for (const double y : {-1.75, 1.75})
    frame.detections.push_back(Detection{.confidence = 0.9, .points = {{0, y + wobble_m, 0}, {25, y, 0}}});
  return frame;
}

recording::RecordedMessage message(recording::AnyMessage content, std::int64_t log_time_ms) {
  return {log_time_ms * kMs, log_time_ms * kMs, std::move(content)};
}

std::vector<PublishedMap> maps_of(const std::vector<recording::RecordedMessage>& messages) {
  std::vector<PublishedMap> maps;
  Replay replay(Config{}, [&](const PublishedMap& map, std::int64_t /*log_time*/) { maps.push_back(map); });
  for (const recording::RecordedMessage& m : messages) replay.add(m);
  return maps;
}

TEST(Replay, GivesAMapPerFrameAlsoWhenOnePoseCompletesSeveral) {
  std::vector<recording::RecordedMessage> messages{message(pose_at(1000), 1000)};
  for (const int stamp_ms : {1010, 1020, 1030}) messages.push_back(message(frame_at(stamp_ms), stamp_ms + 5));
  messages.push_back(message(pose_at(1040), 1045));
  const auto maps = maps_of(messages);
  ASSERT_EQ(maps.size(), 3U);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const std::int64_t stamp_ms = 1010 + 10 * static_cast<std::int64_t>(i);
    EXPECT_EQ(maps[i].sequence, i);
    EXPECT_EQ(maps[i].map.stamp_ns, stamp_ms * kMs);
    EXPECT_EQ(maps[i].published_ns, 1045 * kMs);
    ASSERT_EQ(maps[i].fused_frames.size(), 1U);
    EXPECT_EQ(maps[i].fused_frames[0].sequence, static_cast<std::uint64_t>(stamp_ms));
    EXPECT_DOUBLE_EQ(maps[i].age_s, 1e-3 * static_cast<double>(1045 - stamp_ms - 5));
  }
}

TEST(Replay, AFrameWhosePosesComeTooLateIsRefusedByTheRecordedTime) {
  Replay replay(Config{}, [](const PublishedMap& /*map*/, std::int64_t /*log_time*/) { FAIL(); });
  replay.add(message(pose_at(1000), 1000));
  replay.add(message(frame_at(1005), 1005));
  replay.add(message(pose_at(1010), 9000));
  EXPECT_EQ(replay.counters()["detections_refused_unsynchronised"], 1U);
}

/// A second's drive.
std::vector<io::FrameRecord> drive() {
  std::vector<io::FrameRecord> records;
  for (std::int64_t stamp_ms = 10'000; stamp_ms < 11'000; stamp_ms += 100)
    records.push_back({frame_at(stamp_ms), pose_at(stamp_ms)});
  return records;
}

std::string hash_of(const std::string& path) {
  MapHash hash;
  Replay replay(Config{}, [&](PublishedMap map, std::int64_t /*log_time*/) { hash.add(std::move(map)); });
  const auto source = open_messages(path, "map");
  while (auto next = source->next()) replay.add(std::move(*next));
  EXPECT_EQ(source->progress(), 1.0);
  EXPECT_EQ(replay.counters()["frames_fused"], 10U);
  return hash.text();
}

TEST(Replay, JsonLinesAndRecordingsOfOneDriveHaveOneHash) {
  const TemporaryFolder folder;
  io::JsonLinesWriter lines(folder.file("drive.jsonl"));
  recording::RecordingWriter recording(folder.file("drive.mcap"));
  for (const io::FrameRecord& record : drive()) {
    lines.write(record);
    // Arrival is another one than in the lines, and does not matter.
    recording.write(record.frame, record.frame.stamp_ns + 50 * kMs);
    recording.write(record.pose, record.frame.stamp_ns + 60 * kMs);
  }
  lines.close();
  recording.close();
  const std::string hash = hash_of(folder.file("drive.jsonl"));
  EXPECT_EQ(hash.size(), 32U);
  EXPECT_EQ(hash_of(folder.file("drive.mcap")), hash);
}

/// A second's drive behind a car.
std::vector<io::FrameRecord> drive_behind_a_car() {
  std::vector<io::FrameRecord> records = drive();
  for (std::size_t i = 0; i < records.size(); ++i)
    records[i].objects =
        TrackedObjects{.stamp_ns = records[i].frame.stamp_ns,
                       .session_id = 1,
                       .objects = {{.id = 1,
                                    .kind = ObjectKind::car,
                                    .position = {5.0 + 1.2 * static_cast<double>(i), 0.0, 0.0},
                                    .heading = {1.0, 0.0, 0.0},
                                    .speed_mps = 12.0}}};
  return records;
}

TEST(Replay, ObjectsOfLinesTellDirections) {
  const TemporaryFolder folder;
  const auto evidence_of = [&](const std::vector<io::FrameRecord>& records) {
    const std::string path = folder.file("drive.frames.jsonl");
    io::JsonLinesWriter out(path);
    for (const io::FrameRecord& record : records) out.write(record);
    out.close();
    Evidence evidence = Evidence::none;
    Replay replay(Config{}, [&](const PublishedMap& map, std::int64_t /*log_time*/) {
      for (const Lane& lane : map.map.lanes) evidence |= lane.evidence;
    });
    const auto source = open_messages(path, "map");
    while (auto message = source->next_input()) replay.add(*std::move(message));
    return evidence;
  };
  EXPECT_TRUE(overlap(evidence_of(drive_behind_a_car()), Evidence::traffic));
  EXPECT_FALSE(overlap(evidence_of(drive()), Evidence::traffic));
}

/// A drive of two seconds to the east, up to x = 20 m. Behind x = 30 m the lines of the road are not seen.
std::vector<io::FrameRecord> drive_towards_unseen_road() {
  std::vector<io::FrameRecord> records;
  for (std::int64_t stamp_ms = 100; stamp_ms <= 2000; stamp_ms += 100) {
    records.push_back({frame_at(stamp_ms), pose_at(stamp_ms)});
    for (Detection& line : records.back().frame.detections)
      line.points.back().x() = 30.0 - records.back().pose.position.x();
  }
  return records;
}

/// An extract of one street to the east that bends to the north, 3 m beside its place. A degree is 111 km.
void write_streets(const std::string& path) {
  std::ofstream out(path);
  out << "<osm>";
  int node = 0;
  for (const auto& [x, y] : {std::pair(-60.0, -3.0),
                             {32.0, -3.0},
                             {42.0, -1.0},
                             {52.0, 5.0},
                             {60.0, 15.0},
                             {65.0, 30.0},
                             {65.0, 60.0}})
    out << "<node id='" << ++node << "' lat='" << y / 110574.0 << "' lon='" << x / 111320.0 << "'/>";
  out << "<way id='1'><tag k='highway' v='residential'/>";
  for (int i = 1; i <= node; ++i) out << "<nd ref='" << i << "'/>";
  out << "</way></osm>";
}

TEST(Replay, WhereNothingIsSeenTheWayBendsAsTheStreetOfAnExtractDoes) {
  const TemporaryFolder folder;
  const auto way_with = [](const std::string& extract) {
    Config config;
    config.sd_map.file = extract;
    std::optional<Way> way;
    Replay replay(config, [&](const PublishedMap& map, std::int64_t /*log_time*/) { way = map.map.way; });
    for (const io::FrameRecord& record : drive_towards_unseen_road()) {
      const std::int64_t stamp_ms = record.frame.stamp_ns / kMs;
      replay.add(message(record.pose, stamp_ms));
      replay.add(message(record.frame, stamp_ms));
    }
    return way.value_or(Way{});
  };
  write_streets(folder.file("streets.osm"));
  const Way seen = way_with(""), way = way_with(folder.file("streets.osm"));
  ASSERT_TRUE(seen.is_line() && way.is_line());
  EXPECT_NEAR(seen.stations.back().point.x(), 30.0, 3.0) << "the end of what is seen";
  EXPECT_GT(way.known_m, seen.known_m + 10.0);
  EXPECT_GT(way.stations.back().point.y(), 2.0) << "to the left, as the street bends";
  EXPECT_EQ(way.stations.back().status, ElementStatus::inferred);
  EXPECT_GT(way.stations.back().lateral_stddev_m, way.stations[way.stations.size() - 2].lateral_stddev_m);
}

TEST(Replay, LinesThatAreNoFramesAreLeftOutUnlessThatIsStrict) {
  const TemporaryFolder folder;
  const std::string path = folder.file("drive.jsonl");
  const std::string frame = io::to_json_line(drive().front());
  std::ofstream(path) << "{}\n" << frame << "\n{\"t\":NaN}\n{}\n" << frame.substr(0, 50);
  const auto source = open_messages(path, "map");
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(source->next());
  EXPECT_FALSE(source->next());
  EXPECT_EQ(source->left_out().summary(),
            "2 x t: is missing (first: line 1), 1 x t: must be finite (first: line 3), "
            "1 x the last line is cut off (first: line 5)");
  EXPECT_THROW(open_messages(path, "map", {.strict = true})->next(), std::runtime_error);
  std::ofstream(path) << frame << "\n[" << frame << "]";
  const auto list = open_messages(path, "map");
  EXPECT_TRUE(list->next());
  EXPECT_TRUE(list->next());
  EXPECT_FALSE(list->next());
  EXPECT_EQ(list->left_out().summary(), "1 x must be an object (first: line 2)") << "not that it is cut off";
  std::ofstream(path) << "{}\n";
  EXPECT_THROW(open_messages(path, "map")->next(), std::runtime_error) << "nothing is left";
}

TEST(Replay, FilesOfAnotherKindAreNamed) {
  const TemporaryFolder folder;
  const std::string path = folder.file("drive");
  for (const auto& [begin, kind] :
       {std::pair("SQLite format 3", "is a database of SQLite"),
        std::pair("#ROSBAG V2.0", "is a bag of ROS 1"), std::pair("", "is empty")}) {
    std::ofstream(path) << begin;
    EXPECT_THAT(thrown_by([&] { open_messages(path, "map"); }), testing::StartsWith(path + ": " + kind))
        << kind;
  }
}

TEST(Replay, RawMessagesOfLinesAreThoseOfTheirRecording) {
  const TemporaryFolder folder;
  io::JsonLinesWriter lines(folder.file("drive.jsonl"));
  recording::RecordingWriter recording(folder.file("drive.mcap"));
  for (const io::FrameRecord& record : drive()) {
    lines.write(record);
    recording.write(record.pose, record.pose.stamp_ns);
    recording.write(record.frame, record.frame.stamp_ns);
  }
  lines.close();
  recording.close();
  const auto from_lines = open_messages(folder.file("drive.jsonl"), "map");
  const auto recorded = open_messages(folder.file("drive.mcap"), "map");
  int count = 0;
  while (const auto raw = recorded->next_raw()) {
    const auto other = from_lines->next_raw();
    ASSERT_TRUE(other);
    EXPECT_EQ(raw->topic, other->topic);
    const auto header = dds::header_of(raw->bytes), other_header = dds::header_of(other->bytes);
    ASSERT_TRUE(header && other_header);
    EXPECT_EQ(header->stamp_ns, other_header->stamp_ns);
    EXPECT_EQ(raw->bytes.size(), other->bytes.size());
    EXPECT_EQ(raw->log_time_ns, other->log_time_ns);
    ++count;
  }
  EXPECT_EQ(count, 20);
  EXPECT_FALSE(from_lines->next_raw());
}

TEST(Replay, PosesOfLinesAreNumbered) {
  const TemporaryFolder folder;
  const std::string path = folder.file("drive.jsonl");
  io::JsonLinesWriter out(path);
  for (const io::FrameRecord& record : drive()) out.write(record);
  out.close();
  const auto source = open_messages(path, "map");
  std::uint64_t poses = 0;
  while (const auto message = source->next()) {
    const auto* pose = std::get_if<VehiclePose>(&message->message);
    if (pose != nullptr) {
      EXPECT_EQ(pose->sequence, ++poses);
    }
  }
  EXPECT_EQ(poses, 10U);
}

/// The map as it arrives at a reader.
PublishedMap received(const PublishedMap& map) {
  std::vector<std::uint8_t> bytes;
  dds::to_cdr(map, "map", bytes);
  PublishedMap copy;
  EXPECT_EQ(dds::from_cdr(bytes, "map", copy), "");
  return copy;
}

TEST(LiveComparison, TellsEqualDifferentAndMissing) {
  PublishedMap replayed;
  replayed.map.stamp_ns = 100;
  replayed.map.boundaries.push_back(Marking{.id = 7, .points = {{0, 0, 0}, {1, 0, 0}}});
  replayed.map.T_map_body.rotate(Eigen::AngleAxisd(0.3, Point::UnitZ()));
  PublishedMap live = received(replayed);
  live.sequence = 55;
  live.session_id = 9;
  live.age_s = 0.1;
  live.map.lineage.push_back({.kind = LineageEvent::Kind::born, .id = 7});

  LiveComparison same;
  same.add_replayed(replayed);
  same.add_live(live);
  EXPECT_TRUE(same.result().holds());
  EXPECT_EQ(same.result().equal, 1U);

  LiveComparison changed;
  changed.add_replayed(replayed);
  live.map.boundaries[0].points[1].y() += 1e-12;
  changed.add_live(live);
  EXPECT_EQ(changed.result().different, 1U);
  live.map.stamp_ns = 200;
  changed.add_live(live);
  EXPECT_EQ(changed.result().missing, 1U);
  EXPECT_FALSE(changed.result().holds());
  EXPECT_FALSE(changed.result().began_late);
  live.map.stamp_ns = 50;
  changed.add_live(live);
  EXPECT_TRUE(changed.result().began_late);
  EXPECT_FALSE(LiveComparison().result().holds());

  LiveComparison markings;
  replayed.map.markings = replayed.map.boundaries;
  markings.add_replayed(replayed);
  RoadMarkings other{.stamp_ns = 100, .markings = replayed.map.markings};
  other.markings[0].id = 8;
  markings.add_live(other);
  EXPECT_EQ(markings.result().different, 1U);
}

}  // namespace
}  // namespace laneloom::replay
