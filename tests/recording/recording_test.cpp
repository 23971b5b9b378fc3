#include "recording/recording.hpp"

#include <gtest/gtest.h>

#include "cdr/convert.hpp"
#include "cdr/message_of.hpp"
#include "cdr/random_messages.hpp"
#include "cdr/serialise.hpp"
#include "laneloom/dds/cdr.hpp"
#include "recording/damage.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "recording/topics.hpp"
#include "temporary_folder.hpp"

namespace laneloom::recording {
namespace {

using dds::MessageOf;

constexpr const char* kMapFrame = "map";

template <class T>
std::int64_t stamp_of(const MessageOf<T>& message) {
  return message.header().stamp_ns();
}

/// A random message that has nothing which T has no place for.
template <class T>
MessageOf<T> random_message(unsigned seed) {
  MessageOf<T> message;
  dds::RandomMessages(seed).fill(message);
  if constexpr (std::is_same_v<T, DetectionFrame> || std::is_same_v<T, TrackedObjects>)
    message.header().frame_id("body");
  if constexpr (std::is_same_v<T, VehiclePose>) {
    message.header().frame_id(kMapFrame);
    message.covariance().clear();
  }
  if constexpr (std::is_same_v<T, ServiceStatus> || std::is_same_v<T, NextTurn>)
    message.header().frame_id("");
  return message;
}

template <class T>
T plain(const MessageOf<T>& message) {
  T result;
  EXPECT_EQ(dds::from_msg(MessageOf<T>(message), kMapFrame, result), "");
  return result;
}

template <class T>
MessageOf<T> message_from(const T& plain_message) {
  MessageOf<T> message;
  EXPECT_EQ(dds::to_msg(plain_message, kMapFrame, message), 0U);
  return message;
}

std::vector<RecordedMessage> read_all(const std::string& path) {
  RecordingReader reader(path);
  std::vector<RecordedMessage> messages;
  while (auto message = reader.next()) messages.push_back(std::move(*message));
  EXPECT_TRUE(reader.refused().values().empty());
  return messages;
}

template <class T>
class RecordingOf : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
};

using Types = ::testing::Types<DetectionFrame, VehiclePose, TrackedObjects, NextTurn, PublishedMap,
                               RoadMarkings, ServiceStatus>;
TYPED_TEST_SUITE(RecordingOf, Types);

TYPED_TEST(RecordingOf, EveryFieldIsReadAgain) {
  for (const auto compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    const std::string path =
        this->folder_.file("r" + std::to_string(static_cast<int>(compression)) + ".mcap");
    RecordingWriter writer(path, {.compression = compression});
    EXPECT_EQ(writer.path(), path);
    constexpr unsigned kCount = 40;
    for (unsigned i = 0; i < kCount; ++i)
      writer.write(plain<TypeParam>(random_message<TypeParam>(i)), 1000 + i);
    writer.close();
    EXPECT_EQ(writer.left_out(), 0U);

    const auto messages = read_all(path);
    ASSERT_EQ(messages.size(), kCount);
    for (unsigned i = 0; i < kCount; ++i) {
      const auto expected = random_message<TypeParam>(i);
      EXPECT_EQ(messages[i].log_time_ns, 1000 + i);
      EXPECT_EQ(messages[i].publish_time_ns, stamp_of<TypeParam>(expected));
      const auto* message = std::get_if<TypeParam>(&messages[i].message);
      ASSERT_TRUE(message);
      EXPECT_TRUE(message_from(*message) == expected) << i;
    }
  }
}

TYPED_TEST(RecordingOf, BytesAreKeptAsTheyAre) {
  // Big endian, as other machines write it.
  std::vector<std::uint8_t> big(4 + 40, 0);
  big[27] = 7;  // stamp
  big[35] = 9;  // sequence
  std::vector<std::uint8_t> malformed{0, 1, 0, 0, 5};
  RecordingWriter writer(this->folder_.file("r.mcap"));
  writer.write_cdr<TypeParam>(big, 1);
  writer.write_cdr<TypeParam>(malformed, 2);
  writer.write_cdr<TypeParam>({}, 3);
  writer.write(plain<TypeParam>(random_message<TypeParam>(1)), 4);
  writer.close();

  RecordingReader reader(writer.path());
  const auto message = reader.next();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->log_time_ns, 4);
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.refused()[std::string(topic_of<TypeParam>().name) + ": malformed"], 3U);

  McapReader raw(writer.path());
  auto record = raw.next();
  ASSERT_TRUE(record);
  EXPECT_EQ(Bytes(record->data.begin(), record->data.end()), big);
  EXPECT_EQ(record->publish_time_ns, 7U);
  EXPECT_EQ(record->sequence, 9U);
  record = raw.next();
  ASSERT_TRUE(record);
  EXPECT_EQ(Bytes(record->data.begin(), record->data.end()), malformed);
  EXPECT_EQ(record->publish_time_ns, 2U);  // none of its own
}

TYPED_TEST(RecordingOf, CdrOfTruncatedAndDamagedMessagesIsRefused) {
  Bytes bytes;
  dds::serialise(random_message<TypeParam>(3), bytes);
  TypeParam to;
  ASSERT_EQ(dds::from_cdr(bytes, kMapFrame, to), "");
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(dds::from_cdr(std::span(bytes).first(size), kMapFrame, to), "") << size;
  std::mt19937 engine(1);
  for (int round = 0; round < 2000; ++round) {
    Bytes damaged = bytes;
    for (int i = 0; i < 3; ++i) damaged[engine() % damaged.size()] = static_cast<std::uint8_t>(engine());
    dds::from_cdr(damaged, kMapFrame, to);  // refused or not, it does no harm
  }
}

VehiclePose pose_at(std::int64_t stamp_ns) {
  VehiclePose pose;
  pose.stamp_ns = stamp_ns;
  return pose;
}

TEST(Recording, InputsAreReadWithoutWhatWasPublished) {
  const TemporaryFolder folder;
  RecordingWriter writer(folder.file("r.mcap"));
  writer.write_cdr<PublishedMap>(Bytes{1, 2, 3}, 1);  // nobody looks into it
  writer.write(pose_at(7), 2);
  writer.write(plain<ServiceStatus>(random_message<ServiceStatus>(1)), 3);
  writer.write(plain<RoadMarkings>(random_message<RoadMarkings>(1)), 4);
  writer.write(plain<DetectionFrame>(random_message<DetectionFrame>(1)), 5);
  writer.close();
  RecordingReader reader(writer.path());
  const auto pose = reader.next_input();
  ASSERT_TRUE(pose);
  EXPECT_EQ(std::get<VehiclePose>(pose->message).stamp_ns, 7);
  const auto detections = reader.next_input();
  ASSERT_TRUE(detections);
  EXPECT_TRUE(std::holds_alternative<DetectionFrame>(detections->message));
  EXPECT_EQ(detections->log_time_ns, 5);
  EXPECT_FALSE(reader.next_input());
  EXPECT_TRUE(reader.refused().values().empty());
}

TEST(Recording, TopicsAreMergedInTheOrderOfLogTimes) {
  const TemporaryFolder folder;
  RecordingWriter writer(folder.file("r.mcap"), {.chunk_bytes = 500});
  for (std::int64_t i = 0; i < 50; ++i) {
    writer.write(pose_at(i), 2 * (i % 2 == 0 ? i + 1 : i - 1));  // pairs are exchanged
    writer.write(plain<ServiceStatus>(random_message<ServiceStatus>(1)), 2 * i + 1);
  }
  writer.close();
  const auto messages = read_all(writer.path());
  ASSERT_EQ(messages.size(), 100U);
  RecordingReader reader(writer.path());
  EXPECT_EQ(reader.progress(), 0.0);
  double before = 0.0;
  while (reader.next()) {
    EXPECT_GE(reader.progress(), before);
    before = reader.progress();
  }
  EXPECT_EQ(before, 1.0);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].log_time_ns, static_cast<std::int64_t>(i));
    EXPECT_EQ(std::holds_alternative<VehiclePose>(messages[i].message), i % 2 == 0);
  }
}

std::vector<std::string> files_in(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Recording, RollsOverByTime) {
  const TemporaryFolder folder;
  RecordingWriter writer(folder.file("r.mcap"), {.max_file_s = 1.0});
  for (std::int64_t i = 0; i < 35; ++i) writer.write(pose_at(i), 1'700'000'000'000'000'000 + i * 100'000'000);
  EXPECT_EQ(writer.path(), folder.file("r_0003.mcap"));
  writer.close();
  EXPECT_EQ(files_in(folder),
            (std::vector<std::string>{"r_0000.mcap", "r_0001.mcap", "r_0002.mcap", "r_0003.mcap"}));
  std::int64_t stamp_ns = 0;
  for (const auto& name : files_in(folder)) {
    const auto messages = read_all(folder.file(name));
    EXPECT_EQ(messages.size(), name == "r_0003.mcap" ? 5U : 10U);
    for (const auto& message : messages) EXPECT_EQ(message.publish_time_ns, stamp_ns++);
  }
  EXPECT_EQ(stamp_ns, 35);
}

TEST(Recording, RollsOverBySize) {
  const TemporaryFolder folder;
  constexpr std::uint64_t kMax = 100'000;
  RecordingWriter writer(folder.file("r"),
                         {.compression = Compression::none, .chunk_bytes = 5000, .max_file_bytes = kMax});
  for (std::int64_t i = 0; i < 2000; ++i) writer.write(pose_at(i), i);
  writer.close();
  std::int64_t stamp_ns = 0;
  ASSERT_GT(files_in(folder).size(), 2U);
  for (const auto& name : files_in(folder)) {
    EXPECT_LT(std::filesystem::file_size(folder.file(name)), kMax + 60'000);  // with its index
    for (const auto& message : read_all(folder.file(name))) EXPECT_EQ(message.publish_time_ns, stamp_ns++);
  }
  EXPECT_EQ(stamp_ns, 2000);
}

TEST(Recording, WhatIsFlushedIsThereBeforeTheEnd) {
  const TemporaryFolder folder;
  RecordingWriter writer(folder.file("r.mcap"));
  writer.write(pose_at(1), 1);
  writer.flush();
  writer.write(pose_at(2), 2);
  RecordingReader reader(writer.path());
  EXPECT_TRUE(reader.next());
  EXPECT_THROW(reader.next(), Damage);
  EXPECT_FALSE(reader.next()) << "it is told once";
}

TEST(Recording, AClosedRecordingTakesNoMore) {
  const TemporaryFolder folder;
  RecordingWriter writer(folder.file("r.mcap"));
  writer.close();
  writer.close();
  EXPECT_THROW(writer.write(pose_at(1), 1), std::runtime_error);
  EXPECT_THROW(RecordingWriter(folder.file("r.mcap")), std::runtime_error);
  EXPECT_THROW(RecordingWriter(folder.file("missing/r.mcap")), std::runtime_error);
}

TEST(Recording, PosesOfAnotherMapFrameAreRefused) {
  const TemporaryFolder folder;
  RecordingWriter writer(folder.file("r.mcap"), {.map_frame_id = "odom"});
  writer.write(pose_at(1), 1);
  writer.close();
  RecordingReader wrong(writer.path(), "map");
  EXPECT_FALSE(wrong.next());
  EXPECT_EQ(wrong.refused()["laneloom/v3/vehicle_pose: wrong_frame"], 1U);
  for (const char* right : {"odom", ""}) EXPECT_TRUE(RecordingReader(writer.path(), right).next());
}

TEST(Recording, OthersTopicsAndTypesArePassedOver) {
  const TemporaryFolder folder;
  const auto schema = [](const char* type) {
    return std::make_shared<McapSchema>(McapSchema{type, "omgidl", ""});
  };
  Bytes pose;
  dds::to_cdr(pose_at(1), kMapFrame, pose);
  {
    McapWriter writer(folder.file("r.mcap"), Compression::none, 1000);
    const auto camera = writer.add_channel({"camera", "cdr", schema("Image")});
    const auto other_type = writer.add_channel({dds::kVehiclePoseTopic, "cdr", schema("Pose")});
    const auto json =
        writer.add_channel({dds::kVehiclePoseTopic, "json", schema("laneloom::msg::VehiclePose")});
    const auto ours =
        writer.add_channel({dds::kVehiclePoseTopic, "cdr", schema("laneloom::msg::VehiclePose")});
    for (const auto channel : {camera, other_type, json, ours}) writer.write(channel, 1, 1, 1, pose);
    writer.close();
  }
  RecordingReader reader(folder.file("r.mcap"));
  EXPECT_TRUE(reader.next());
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.refused()["camera: not a topic of laneloom"], 1U);
  EXPECT_EQ(reader.refused()["laneloom/v3/vehicle_pose: another type"], 1U);
  EXPECT_EQ(reader.refused()["laneloom/v3/vehicle_pose: unknown encoding"], 1U);
}

TEST(Recording, InputsOfVersion2AreReadAndItsMapsAreCounted) {
  const TemporaryFolder folder;
  const auto channel = [](const char* topic, const char* type) {
    return McapChannel{topic, "cdr", std::make_shared<McapSchema>(McapSchema{type, "omgidl", ""})};
  };
  Bytes pose, frame;
  dds::to_cdr(pose_at(1), kMapFrame, pose);
  dds::to_cdr(plain<DetectionFrame>(random_message<DetectionFrame>(1)), kMapFrame, frame);
  {
    McapWriter writer(folder.file("r.mcap"), Compression::none, 1000);
    const auto poses = writer.add_channel(channel("laneloom/v2/vehicle_pose", dds::kVehiclePoseType));
    const auto frames = writer.add_channel(channel("laneloom/v2/detections", dds::kDetectionsType));
    const auto maps = writer.add_channel(channel("laneloom/v2/lane_map", dds::kLaneMapType));
    writer.write(poses, 1, 1, 1, pose);
    writer.write(frames, 2, 1, 1, frame);
    writer.write(maps, 3, 1, 1, frame);
    writer.close();
  }
  RecordingReader reader(folder.file("r.mcap"));
  EXPECT_TRUE(std::holds_alternative<VehiclePose>(reader.next().value().message));
  EXPECT_TRUE(std::holds_alternative<DetectionFrame>(reader.next().value().message));
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.refused()["laneloom/v2/lane_map: another version of the topics"], 1U);
  EXPECT_EQ(reader.refused().values().size(), 1U);
}

TEST(Recording, LogTimesWhoseDifferencesOverflowAreRefused) {
  const TemporaryFolder folder;
  Bytes pose;
  dds::to_cdr(pose_at(1), kMapFrame, pose);
  {
    McapWriter writer(folder.file("r.mcap"), Compression::none, 1000);
    const auto poses = writer.add_channel(
        {dds::kVehiclePoseTopic, "cdr",
         std::make_shared<McapSchema>(McapSchema{"laneloom::msg::VehiclePose", "omgidl", ""})});
    for (const std::uint64_t log_time_ns :
         {std::uint64_t{1} << 62U, (std::uint64_t{1} << 62U) + 1, ~std::uint64_t{0}})
      writer.write(poses, log_time_ns, 1, 1, pose);
    writer.close();
  }
  RecordingReader reader(folder.file("r.mcap"));
  const auto message = reader.next();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->log_time_ns, std::int64_t{1} << 62U);
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.refused()["laneloom/v3/vehicle_pose: log time"], 2U);
  RecordingReader raw(folder.file("r.mcap"));
  EXPECT_TRUE(raw.next_raw());
  EXPECT_FALSE(raw.next_raw());
}

}  // namespace
}  // namespace laneloom::recording
