#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cdr/message_of.hpp"
#include "cdr/random_messages.hpp"
#include "cdr/serialise.hpp"
#include "cyclone.hpp"
#include "end_to_end/participants.hpp"
#include "end_to_end/process.hpp"
#include "end_to_end/service.hpp"
#include "laneloom/dds/raw_reader.hpp"
#include "laneloom/dds/raw_writer.hpp"
#include "recording/message_json.hpp"

// A participant of another vendor, in C (cyclone_participant.c), on the types that its own tool made of idl/.
namespace laneloom {
namespace {

using nlohmann::json;

/// Messages of one topic by their sequence number.
using Messages = std::map<std::string, json>;

Messages::value_type by_sequence(json message) {
  std::string sequence = message.at("header").at("sequence_number");
  return {std::move(sequence), std::move(message)};
}

template <class T>
json json_of_cdr(std::span<const std::uint8_t> bytes) {
  dds::MessageOf<T> message;
  if (!dds::deserialise(bytes, message).empty()) return {{"header", {{"sequence_number", "malformed"}}}};
  return json_of(message);
}

/// The messages of one topic that Fast DDS received.
template <class T>
class OurReader {
 public:
  explicit OurReader(const DdsConfig& config)
      : participant_(config, "our reader"),
        reader_(participant_, [this](const dds::WriterId& /*writer*/, std::vector<std::uint8_t>&& bytes) {
          const std::lock_guard lock(mutex_);
          messages_.insert(by_sequence(json_of_cdr<T>(bytes)));
        }) {}

  Messages messages() {
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  bool refused_datagrams() const { return !participant_.refused_datagrams().values().empty(); }

 private:
  std::mutex mutex_;
  Messages messages_;
  dds::Participant participant_;
  dds::RawReader<T> reader_;
};

class Cyclone : public ::testing::Test {
 protected:
  void SetUp() override {
#ifdef CYCLONE_PARTICIPANT
    participant_ = start_cyclone(
        {CYCLONE_PARTICIPANT, std::to_string(config_.domain), config_.vehicle_id, output_.path});
#else
    GTEST_SKIP() << "Cyclone DDS is missing (tools/setup: cyclonedds-dev, cyclonedds-tools)";
#endif
  }

  /// The messages of a topic that Cyclone has written or received so far. Its newest line may not be whole
  /// yet.
  std::vector<json> cyclone(std::string_view topic) const {
    std::vector<json> found;
    std::ifstream file(output_.path);
    const std::string start = R"({"topic":")" + std::string(topic) + '"';
    for (std::string line; std::getline(file, line);) {
      if (!line.starts_with(start)) continue;
      json entry = json::parse(line, nullptr, false);
      if (!entry.is_discarded()) found.push_back(std::move(entry["message"]));
    }
    return found;
  }

  /// Waits (for half a minute at most) until Cyclone has so many messages of the topic that are `wanted`.
  testing::AssertionResult wait_for(
      std::string_view topic, std::ptrdiff_t count,
      const std::function<bool(const json&)>& wanted = [](const json&) { return true; }) const {
    for (int i = 0; i < 150; ++i) {
      const auto messages = cyclone(topic);
      if (std::count_if(messages.begin(), messages.end(), wanted) >= count)
        return testing::AssertionSuccess();
      usleep(200'000);
    }
    return testing::AssertionFailure() << "too few of " << topic << "; " << participant_->errors();
  }

  /// Every message that both have is the same, in every field; they have at least `at_least` in common.
  void expect_equal(std::string_view topic, const Messages& ours, int at_least) const {
    int common = 0;
    for (const auto& message : cyclone(topic)) {
      const auto [sequence, theirs] = by_sequence(message);
      const auto found = ours.find(sequence);
      if (found == ours.end()) continue;
      ++common;
      ASSERT_TRUE(found->second == theirs) << topic << ", " << json::diff(found->second, theirs);
    }
    EXPECT_GE(common, at_least) << topic;
  }

  const DdsConfig config_ = private_config("cyclone");
  const TemporaryFile output_{"cyclone.jsonl", ""};
  std::unique_ptr<Process> participant_;
};

bool has_a_lane(const json& map) {
  constexpr auto kOk = static_cast<std::uint32_t>(msg::MapState::MAP_OK);
  return map.at("state") == kOk && !map.at("lanes").empty() && !map.at("fused_frames").empty();
}

TEST_F(Cyclone, DrivesTheServiceAndReadsItsMap) {
  OurReader<DetectionFrame> detections(config_);
  OurReader<VehiclePose> poses(config_);
  OurReader<PublishedMap> maps(config_);
  OurReader<RoadMarkings> markings(config_);
  OurReader<ServiceStatus> statuses(config_);
  const Process service(command(config_));
  ASSERT_TRUE(wait_for("lane_map", 20, has_a_lane)) << service.errors();
  ASSERT_TRUE(wait_for("status", 3, [](const json& status) {
    return !status.at("sources").empty() && status.at("sources")[0].at("source") == "cyclone";
  }));

  EXPECT_EQ(service.errors().find("datagrams_refused"), std::string::npos) << service.errors();
  EXPECT_FALSE(detections.refused_datagrams() || maps.refused_datagrams());

  // Its planner learns that the service is gone.
  service.signal(SIGKILL);
  ASSERT_TRUE(wait_for("alive", 1, [](const json& writers) { return writers == 0; }));
  participant_.reset();

  expect_equal("detections", detections.messages(), 10);
  expect_equal("vehicle_pose", poses.messages(), 100);
  expect_equal("lane_map", maps.messages(), 10);
  expect_equal("road_markings", markings.messages(), 10);
  expect_equal("status", statuses.messages(), 2);
  EXPECT_TRUE(cyclone("damaged").empty()) << "of messages that nobody damaged";
}

/// Writes ten messages with every field set, by a writer of ours, and what is in them to `written`, by
/// sequence number. The next one waits until `arrived` says that the last is there: the writer keeps no
/// other.
template <class T>
void write_random(const DdsConfig& config,
                  const std::function<testing::AssertionResult(const std::string&)>& arrived,
                  Messages& written) {
  const dds::Participant participant(config, "random messages");
  dds::RawWriter<T> writer(participant);
  for (int i = 0; i < 3000 && writer.matched() == 0; ++i) usleep(10'000);
  usleep(500'000);  // until the reader knows the writer, too
  dds::RandomMessages random(1);
  for (int i = 0; i < 10; ++i) {
    dds::MessageOf<T> message;
    random.fill(message);
    std::vector<std::uint8_t> bytes;
    dds::serialise(message, bytes);
    dds::deserialise(bytes, message);  // its header has the checksum now
    ASSERT_TRUE(writer.write(bytes));
    const auto entry = by_sequence(json_of(message));
    written.insert(entry);
    ASSERT_TRUE(arrived(entry.first));
  }
}

TEST_F(Cyclone, ReadsEveryFieldOfEveryTopicOfTheService) {
  const auto compare = [this]<class T>(std::string_view topic, std::in_place_type_t<T>) {
    const auto arrived = [&](const std::string& sequence) {
      return wait_for(topic, 1, [&](const json& m) { return m["header"]["sequence_number"] == sequence; });
    };
    Messages written;
    write_random<T>(config_, arrived, written);
    expect_equal(topic, written, 10);
    EXPECT_TRUE(cyclone("damaged").empty()) << topic;
  };
  compare("lane_map", std::in_place_type<PublishedMap>);
  compare("road_markings", std::in_place_type<RoadMarkings>);
  compare("status", std::in_place_type<ServiceStatus>);
}

}  // namespace
}  // namespace laneloom
