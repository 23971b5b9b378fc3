#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "cyclone.hpp"
#include "end_to_end/participants.hpp"
#include "end_to_end/process.hpp"
#include "end_to_end/service.hpp"
#include "recording/recording.hpp"
#include "support/child_process.hpp"
#include "temporary_folder.hpp"

// A node of ROS 2 as it is on DDS (cyclone_ros_node.c) and the service with ros2.enabled.
namespace laneloom {
namespace {

using nlohmann::json;

bool counts(const ServiceStatus& status, const std::string& counter) {
  return std::ranges::any_of(status.counters,
                             [&](const auto& entry) { return entry.first == counter && entry.second > 0; });
}

class CycloneRosNode : public ::testing::Test {
 protected:
  void SetUp() override { start_node(); }

  void start_node(const std::vector<std::string>& more = {}) {
#ifdef CYCLONE_ROS_NODE
    node_.reset();
    std::vector<std::string> words{CYCLONE_ROS_NODE, std::to_string(config_.domain), kNamespace,
                                   output_.path};
    words.insert(words.end(), more.begin(), more.end());
    node_ = start_cyclone(words);
#else
    GTEST_SKIP() << "Cyclone DDS is missing (tools/setup: cyclonedds-dev, cyclonedds-tools)";
#endif
  }

  /// Starts the service with these lines more in the section ros2.
  void start_service(const std::string& more = "") {
    service_config_.write("ros2:\n  enabled: true\n  namespace: " + std::string(kNamespace) + "\n" + more);
    service_ = std::make_unique<Process>(command(config_, {"--config", service_config_.path}));
  }

  /// The messages that the node has read so far. Its newest line may not be whole yet.
  std::vector<json> read(const std::string& topic) const {
    std::vector<json> found;
    std::ifstream file(output_.path);
    for (std::string line; std::getline(file, line);) {
      json entry = json::parse(line, nullptr, false);
      if (!entry.is_discarded() && entry["topic"] == topic) found.push_back(std::move(entry));
    }
    return found;
  }
  /// Waits (for half a minute at most) until the node has read what is `wanted`.
  testing::AssertionResult wait_for(const std::string& topic,
                                    const std::function<bool(const json&)>& wanted) const {
    for (int i = 0; i < 150; ++i) {
      if (std::ranges::any_of(read(topic), wanted)) return testing::AssertionSuccess();
      usleep(200'000);
    }
    return testing::AssertionFailure()
           << "not read: " << topic << "; " << node_->errors() << service_->errors();
  }

  static constexpr const char* kNamespace = "/fleet/car_1";
  const DdsConfig config_ = private_config("ros");
  const TemporaryFile output_{"node.jsonl", ""};
  const TemporaryFile service_config_{"laneloom.yaml", ""};
  std::unique_ptr<Process> node_, service_;
};

TEST_F(CycloneRosNode, DrivesTheServiceAndReadsItsMap) {
  start_service();
  EXPECT_TRUE(wait_for("lane_map", [](const json& map) {
    return map["state"] == 0 && map["lanes"] == 1 && map["fused"] > 0 && map["session"] == true;
  }));
  for (const std::string ns : {"boundaries", "lanes", "state"}) {
    EXPECT_TRUE(wait_for("marker", [&](const json& marker) {
      return marker["ns"] == ns && marker["action"] == 0 && marker["frame"] == "map";
    })) << ns;
  }
  EXPECT_TRUE(wait_for("segment", [](const json& segment) {
    return segment["frame"] == "base_link" && segment["id"] == 0 && segment["neighbours"] == 2 &&
           std::abs(segment["left_y"].get<double>() - 1.75) < 0.1 &&
           std::abs(segment["right_y"].get<double>() + 1.75) < 0.1 && segment["ego_x"] > 10.0;
  }));
  EXPECT_TRUE(wait_for("diagnostics", [&](const json& status) {
    return status["name"] == "/fleet/car_1/laneloom: lane map" && status["level"] == 0 &&
           status["message"] == "OK" && status["hardware"] == config_.vehicle_id;
  }));
  EXPECT_TRUE(read("node").empty()) << "announced, but nobody asked";
}

TEST_F(CycloneRosNode, ItsObjectsTellTheDirectionOfTheirLane) {
  start_service();
  EXPECT_TRUE(wait_for("lane_map", [](const json& map) { return map["traffic"] == true; }));
}

TEST_F(CycloneRosNode, ObjectsOfAnotherFrameAreRefusedAndCounted) {
  Listener<ServiceStatus> statuses(config_);
  start_service("dds:\n  map_frame_id: odom\n");
  EXPECT_TRUE(statuses.wait_for(
      [](const ServiceStatus& status) { return counts(status, "objects_refused_wrong_frame"); }));
}

TEST_F(CycloneRosNode, IsRecordedAsThoughItWroteTheServicesOwnTopics) {
  const TemporaryFolder folder;
  const std::string recording = folder.file("node.mcap");
  service_config_.write("ros2:\n  enabled: true\n  namespace: " + std::string(kNamespace) + "\n");
  support::ChildProcess recorder(
      {LANELOOM_COMMAND, "record", "--config", service_config_.path, "--domain",
       std::to_string(config_.domain), "--vehicle-id", config_.vehicle_id, "--out", recording},
      folder.file("record.log"));
  const auto has_all_inputs = [&] {
    std::set<std::size_t> topics;
    try {
      recording::RecordingReader reader(recording);
      while (const auto message = reader.next_raw()) topics.insert(message->topic);
    } catch (const std::runtime_error&) {
      return false;  // it is not there yet
    }
    return topics == std::set<std::size_t>{0, 1, 5};
  };
  for (int i = 0; i < 150 && !has_all_inputs(); ++i) usleep(200'000);
  recorder.signal(SIGINT);
  EXPECT_EQ(recorder.wait(), 0) << content(folder.file("record.log"));
  EXPECT_TRUE(has_all_inputs());
  EXPECT_EQ(content(folder.file("record.log")).find("refused"), std::string::npos);
  recording::RecordingReader reader(recording);
  std::size_t objects = 0;
  while (const auto message = reader.next())
    if (const auto* seen = std::get_if<TrackedObjects>(&message->message)) objects += seen->objects.size();
  EXPECT_GT(objects, 0U);
  EXPECT_TRUE(reader.refused().values().empty());
}

TEST_F(CycloneRosNode, MarkersKeepTheirIds) {
  start_service();
  ASSERT_TRUE(wait_for("marker", [](const json& marker) { return marker["ns"] == "lanes"; }));
  const auto before = read("lane_map").size();
  for (int i = 0; i < 300 && read("lane_map").size() < before + 20; ++i) usleep(100'000);
  std::vector<int> ids;
  for (const json& marker : read("marker"))
    if (marker["ns"] == "state") ids.push_back(marker["id"]);
  ASSERT_GT(ids.size(), 20U);
  EXPECT_EQ(std::ranges::count(ids, ids.front()), static_cast<std::ptrdiff_t>(ids.size()));
}

TEST_F(CycloneRosNode, NothingOfItIsRefusedAtTheDoor) {
  Listener<ServiceStatus> statuses(config_);
  start_service("  announce: true\n");
  ASSERT_TRUE(wait_for("lane_map", [](const json& map) { return map["lanes"] == 1; }));
  statuses.forget();
  ASSERT_TRUE(statuses.wait_for([](const ServiceStatus&) { return true; }));
  EXPECT_FALSE(refused_datagrams(statuses.samples().back()));
  EXPECT_FALSE(statuses.refused_datagrams());
}

TEST_F(CycloneRosNode, AnotherWriterOfOdometryIsAnotherSession) {
  Listener<ServiceStatus> statuses(config_);
  start_service();
  ASSERT_TRUE(wait_for("lane_map", [](const json& map) { return map["lanes"] == 1; }));
  EXPECT_FALSE(statuses.samples().empty() || counts(statuses.samples().back(), "map_resets"));
  start_node();
  EXPECT_TRUE(statuses.wait_for([](const ServiceStatus& status) { return counts(status, "map_resets"); }));
  EXPECT_TRUE(wait_for("lane_map", [](const json& map) { return map["state"] == 0 && map["lanes"] == 1; }));
}

TEST_F(CycloneRosNode, NoRoadSegmentsAreWrittenOfAStaleMap) {
  start_node({"3"});
  start_service();
  ASSERT_TRUE(wait_for("segment", [](const json&) { return true; }));
  int stale = 0;
  std::size_t segments = 0;
  for (int i = 0; i < 300 && stale < 20; ++i, usleep(100'000)) {
    stale = 0;
    for (const json& map : read("lane_map")) stale = map["state"] == 2 ? stale + 1 : 0;
    if (stale < 3) segments = read("segment").size();
  }
  EXPECT_GE(stale, 20);
  EXPECT_LE(read("segment").size(), segments + 5) << "of which some may have been on their way";
}

TEST_F(CycloneRosNode, ReopensItsEndpointsAtAReload) {
  start_service();
  ASSERT_TRUE(wait_for("lane_map", [](const json& map) { return map["lanes"] == 1; }));
  service_->signal(SIGHUP);
  ASSERT_TRUE(service_->wait_for_error("event=reopened")) << service_->errors();
  const auto before = read("marker").size();
  EXPECT_TRUE(wait_for("marker", [&](const json&) { return read("marker").size() > before + 20; }));
}

TEST_F(CycloneRosNode, OdometryOfAnotherFrameIsRefusedAndCounted) {
  Listener<ServiceStatus> statuses(config_);
  start_service("dds:\n  map_frame_id: odom\n");
  EXPECT_TRUE(statuses.wait_for(
      [](const ServiceStatus& status) { return counts(status, "poses_refused_wrong_frame"); }));
}

TEST_F(CycloneRosNode, IsToldTheHashesOfTheTypes) {
  start_service();
  const auto told = [&](const std::string& kind, const std::string& name, const std::string& text) {
    return wait_for(kind, [&](const json& entry) {
      return entry["name"] == name && entry["user_data"].get<std::string>().starts_with(text);
    });
  };
  EXPECT_TRUE(told("participant", "", "enclave=/;"));
  EXPECT_TRUE(told("reader", "rt/fleet/car_1/odom",
                   "typehash=RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0;"));
  EXPECT_TRUE(told("reader", "rt/fleet/car_1/laneloom/detections", "typehash=RIHS01_"));
  EXPECT_TRUE(told("reader", "rt/fleet/car_1/tracked_objects",
                   "typehash=RIHS01_3559bd4e62ce8a4d96e32720c02bbe656cc090bb2b3f3f91f52a7c3ab095417a;"));
  EXPECT_TRUE(told("writer", "rt/fleet/car_1/laneloom/lane_map", "typehash=RIHS01_"));
  EXPECT_TRUE(told("writer", "rt/fleet/car_1/laneloom/markers",
                   "typehash=RIHS01_86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf;"));
  EXPECT_TRUE(told("writer", "rt/fleet/car_1/laneloom/road_segments",
                   "typehash=RIHS01_61e98577e4de1fd1307e9bdfc809000f99d188c35ed507fe6aa575f5a0445352;"));
  EXPECT_TRUE(told("writer", "rt/diagnostics",
                   "typehash=RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e;"));
}

TEST_F(CycloneRosNode, IsToldOfTheNodeThatTheServiceIs) {
  start_service("  announce: true\n");
  EXPECT_TRUE(wait_for("node", [](const json& node) {
    // Detections have two readers.
    return node["namespace"] == "/fleet/car_1" && node["name"] == "laneloom" && node["readers"] == 5 &&
           node["writers"] == 4;
  }));
}

}  // namespace
}  // namespace laneloom
