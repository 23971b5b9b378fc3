#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>

#include "commands.hpp"
#include "file_size_limit.hpp"
#include "laneloom/dds/topics.hpp"
#include "own_domain.hpp"
#include "recording/damage.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/recording.hpp"

// `laneloom record` beside the service and its test publisher, as processes of their own over DDS.
namespace laneloom::recording {
namespace {

using testing::HasSubstr;

class RecordCommand : public Commands {
 protected:
  void start_vehicle() {
    service_.emplace(in_folder("exec laneloomd" + dds_), file("service.log"));
    publisher_.emplace(in_folder("exec laneloom publish --scenario straight --loop" + dds_),
                       file("publish.log"));
  }
  support::ChildProcess record(const std::string& options) const {
    return start("laneloom record " + options + dds_, "output");
  }

  /// Until `condition` is met, or half a minute has gone.
  template <class Condition>
  static bool wait_for(Condition condition) {
    for (int i = 0; i < 600 && !condition(); ++i) usleep(50'000);
    return condition();
  }
  bool grows_to(const std::string& name, std::uintmax_t bytes) {
    return wait_for([&] {
      std::error_code error;
      const auto size = std::filesystem::file_size(file(name), error);
      return !error && size >= bytes;
    });
  }

  /// How many messages there are of each topic, in the order of AnyMessage.
  std::array<int, 5> counts_of(const std::string& name, bool cut_off) {
    RecordingReader reader(file(name));
    LeftOut left_out;
    std::array<int, 5> counts{};
    std::int64_t log_time_ns = 0;
    while (const auto message = next_or_leave_out(left_out, [&] { return reader.next(); })) {
      ++counts.at(message->message.index());
      EXPECT_GE(message->log_time_ns, log_time_ns);
      log_time_ns = message->log_time_ns;
    }
    EXPECT_EQ(left_out.count(), cut_off ? 1U : 0U);
    EXPECT_TRUE(reader.refused().values().empty());
    return counts;
  }

  /// The file is read while it is written, as one that is cut off.
  bool wait_for_every_topic(const std::string& name) {
    return grows_to(name, 1) && wait_for([&] {
             const auto counts = counts_of(name, true);
             return std::ranges::all_of(counts, [](int count) { return count > 0; });
           });
  }

  const std::string dds_ =
      " --domain " + std::to_string(own_domain()) + " --vehicle-id record" + std::to_string(getpid());
  std::optional<support::ChildProcess> service_, publisher_;
};

TEST_F(RecordCommand, EveryTopicIsRecorded) {
  start_vehicle();
  support::ChildProcess recorder = record("--out drive.mcap");
  ASSERT_TRUE(wait_for_every_topic("drive.mcap")) << output();
  recorder.signal(SIGTERM);
  EXPECT_EQ(recorder.wait(), 0) << output();

  const auto counts = counts_of("drive.mcap", false);
  const std::array topics{dds::kDetectionsTopic, dds::kVehiclePoseTopic, dds::kLaneMapTopic,
                          dds::kRoadMarkingsTopic, dds::kStatusTopic};
  for (std::size_t i = 0; i < topics.size(); ++i) {
    EXPECT_GT(counts.at(i), 0) << topics.at(i);
    const auto line = output().find(topics.at(i));
    ASSERT_NE(line, std::string::npos) << output();
    EXPECT_EQ(std::stoi(output().substr(line + std::string(topics.at(i)).size())), counts.at(i));
  }

  // Stamps are the sensor clock's, which the publisher starts with the system clock.
  RecordingReader reader(file("drive.mcap"));
  while (const auto message = reader.next()) {
    if (const auto* pose = std::get_if<VehiclePose>(&message->message)) {
      EXPECT_EQ(message->publish_time_ns, pose->stamp_ns);
      EXPECT_LT(std::abs(message->log_time_ns - pose->stamp_ns), 60'000'000'000);
    }
  }
}

TEST_F(RecordCommand, ScenesAreMadeOfWhatIsRecorded) {
  start_vehicle();
  support::ChildProcess recorder = record("--out drive.mcap --scene");
  const auto counts_of_topics = [&] {
    std::map<std::string, int> counts;
    McapReader reader(file("drive.mcap"));
    while (const auto message = reader.next()) ++counts[message->channel->topic];
    return counts;
  };
  ASSERT_TRUE(wait_for_every_topic("drive.mcap")) << output();
  // A frame is drawn once its pose has come.
  ASSERT_TRUE(wait_for([&] { return counts_of_topics()["/laneloom/scene/detections"] > 0; }));
  recorder.signal(SIGTERM);
  EXPECT_EQ(recorder.wait(), 0) << output();
  auto counts = counts_of_topics();
  EXPECT_EQ(counts["/laneloom/scene"], counts[dds::kLaneMapTopic]);
  EXPECT_EQ(counts["/tf"], counts[dds::kVehiclePoseTopic]);
}

TEST_F(RecordCommand, AKilledRecorderLeavesAReadableFile) {
  start_vehicle();
  support::ChildProcess recorder = record("--out drive.mcap --compression lz4");
  ASSERT_TRUE(wait_for_every_topic("drive.mcap")) << output();
  recorder.signal(SIGKILL);
  EXPECT_EQ(recorder.wait(), -SIGKILL);
  const auto counts = counts_of("drive.mcap", true);
  for (const int count : counts) EXPECT_GT(count, 0);
}

TEST_F(RecordCommand, FilesRollOver) {
  start_vehicle();
  support::ChildProcess recorder = record("--out drive --max-duration 1");
  ASSERT_TRUE(grows_to("drive_0003.mcap", 1)) << output();
  recorder.signal(SIGINT);
  EXPECT_EQ(recorder.wait(), 0) << output();
  int poses = 0;
  for (const char* name : {"drive_0000.mcap", "drive_0001.mcap", "drive_0002.mcap", "drive_0003.mcap"}) {
    const auto counts = counts_of(name, false);
    EXPECT_GT(std::accumulate(counts.begin(), counts.end(), 0), 0) << name;
    poses += counts[1];
  }
  EXPECT_GT(poses, 0);
  EXPECT_FALSE(exists("drive.mcap"));
}

TEST_F(RecordCommand, AFullDiskEndsTheRecordingWithAnError) {
  start_vehicle();
  const FileSizeLimit limit(150'000);
  support::ChildProcess recorder = record("--out drive.mcap");
  EXPECT_EQ(recorder.wait(), 1);
  EXPECT_THAT(output(), HasSubstr("drive.mcap: File too large"));
  EXPECT_GT(counts_of("drive.mcap", true)[1], 0);
}

TEST_F(RecordCommand, EndsByItselfAndTellsIfNobodyWasThere) {
  EXPECT_EQ(record("--out . --duration 0.3").wait(), 3);
  EXPECT_THAT(output(), HasSubstr("nobody was heard in domain"));
  int recordings = 0;
  for (const auto& entry : std::filesystem::directory_iterator(file(""))) {
    if (entry.path().extension() != ".mcap") continue;
    ++recordings;
    EXPECT_THAT(entry.path().filename().string(), testing::StartsWith("laneloom_2"));
  }
  EXPECT_EQ(recordings, 1);
}

TEST_F(RecordCommand, WrongOptionsAreRefused) {
  write_bytes(file("mine.mcap"), {1, 2, 3});
  EXPECT_EQ(record("--out mine.mcap").wait(), 1);
  EXPECT_THAT(output(), HasSubstr("mine.mcap: File exists"));
  EXPECT_EQ(bytes_of(file("mine.mcap")).size(), 3U);
  EXPECT_EQ(record("--out missing/drive.mcap").wait(), 1);
  EXPECT_THAT(output(), HasSubstr("missing/drive.mcap: No such file"));
  EXPECT_NE(record("--compression rar").wait(), 0);
  EXPECT_NE(record("--max-size -1").wait(), 0);
}

}  // namespace
}  // namespace laneloom::recording
