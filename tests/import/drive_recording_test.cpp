#include "import/drive_recording.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "recording/recording.hpp"
#include "session/mapping_session.hpp"
#include "temporary_folder.hpp"

namespace laneloom::imports {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::vector<VehiclePose> poses(int count) {
  std::vector<VehiclePose> poses;
  poses.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    poses.push_back({.stamp_ns = kSecond_ns + i * kSecond_ns / 10, .position = Point(i, 0, 0)});
  return poses;
}

DetectionFrame frame(std::int64_t stamp_ns) {
  return {.stamp_ns = stamp_ns,
          .source = "test",
          .detections = {{.confidence = 0.9, .points = {{0, 2, 0}, {20, 2, 0}}}}};
}

TEST(DriveRecording, AServiceFusesEveryFrameInTheOrderOfLogTimes) {
  const TemporaryFolder folder;
  std::vector<DetectionFrame> frames;
  frames.reserve(10);
  for (int i = 0; i < 9; ++i) frames.push_back(frame(kSecond_ns + i * kSecond_ns / 10 + 50'000'000));
  frames.push_back(frame(kSecond_ns + 9 * kSecond_ns / 10));  // at the last pose itself
  write_drive(folder.file("drive.mcap"), poses(10), frames);

  recording::RecordingReader reader(folder.file("drive.mcap"));
  session::MappingSession session{Config{}};
  while (const auto message = reader.next()) {
    session.expire(message->log_time_ns);
    if (const auto* pose = std::get_if<VehiclePose>(&message->message)) session.add(*pose);
    if (const auto* seen = std::get_if<DetectionFrame>(&message->message))
      session.add(*seen, message->log_time_ns);
  }
  const auto fused = session.take_progress().fused;
  ASSERT_EQ(fused.size(), 10u);
  for (std::size_t i = 0; i < fused.size(); ++i) {
    EXPECT_EQ(fused[i].sequence, i + 1);
    EXPECT_EQ(fused[i].stamp_ns, frames[i].stamp_ns);
  }
  EXPECT_EQ(session.counters()["poses_accepted"], 10u);
}

TEST(DriveRecording, AServiceFusesAllObjects) {
  const TemporaryFolder folder;
  std::vector<DetectionFrame> frames;
  std::vector<TrackedObjects> objects;
  for (const int ms : {0, 50, 150, 200, 850, 899}) {
    objects.push_back({.stamp_ns = kSecond_ns + ms * 1'000'000, .objects = {{.id = 7}}});
    if (ms % 200 != 50) frames.push_back(frame(objects.back().stamp_ns));
  }
  write_drive(folder.file("drive.mcap"), poses(10), frames, {.objects = objects});
  recording::RecordingReader reader(folder.file("drive.mcap"));
  session::MappingSession session{Config{}};
  std::vector<std::uint64_t> sequences;
  while (auto message = reader.next()) {
    if (const auto* pose = std::get_if<VehiclePose>(&message->message)) session.add(*pose);
    if (const auto* seen = std::get_if<DetectionFrame>(&message->message))
      session.add(*seen, message->log_time_ns);
    if (auto* others = std::get_if<TrackedObjects>(&message->message)) {
      sequences.push_back(others->sequence);
      session.add(std::move(*others));
    }
  }
  EXPECT_EQ(sequences, (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(session.counters()["objects_fused"], 6U);
}

TEST(DriveRecording, FramesWithoutPosesAroundThemGo) {
  std::vector<VehiclePose> with_gap = poses(10);
  with_gap.erase(with_gap.begin() + 4, with_gap.begin() + 7);  // 1.3 s, then 1.7 s
  std::vector<DetectionFrame> frames{frame(kSecond_ns - 1), frame(kSecond_ns), frame(kSecond_ns * 3 / 2),
                                     frame(kSecond_ns * 2)};
  EXPECT_EQ(drop_frames_without_pose(frames, with_gap), 3u);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].stamp_ns, kSecond_ns);
}

TEST(DriveRecording, WhatExceedsAMessageIsLeftOutOrAnError) {
  const TemporaryFolder folder;
  DetectionFrame crowded = frame(kSecond_ns);
  crowded.detections.resize(513, crowded.detections.front());
  EXPECT_THROW(write_drive(folder.file("drive.mcap"), poses(2), {crowded}, {}, true), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder.file("drive.mcap")));
  EXPECT_EQ(write_drive(folder.file("drive.mcap"), poses(2), {crowded}).count(), 1u);
}

TEST(DriveRecording, SessionsAreKept) {
  const TemporaryFolder folder;
  std::vector<VehiclePose> of_two = poses(4);
  of_two[2].session_id = of_two[3].session_id = 7;
  write_drive(folder.file("drive.mcap"), of_two, {});
  recording::RecordingReader reader(folder.file("drive.mcap"));
  std::vector<std::uint64_t> sessions;
  while (const auto message = reader.next())
    sessions.push_back(std::get<VehiclePose>(message->message).session_id);
  EXPECT_EQ(sessions, (std::vector<std::uint64_t>{1, 1, 7, 7}));
}

}  // namespace
}  // namespace laneloom::imports
