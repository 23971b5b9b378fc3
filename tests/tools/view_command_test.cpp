#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "config/config_file.hpp"
#include "recording/recording.hpp"
#include "view/client.hpp"

// What `laneloom view` shows of a file, and what `laneloom replay --explain` tells of it.
namespace laneloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ViewCommand : public Commands {
 protected:
  void SetUp() override {
    simulate("none", "in.frames.jsonl");
    ASSERT_TRUE(done("cut in.frames.jsonl --out in.mcap"));
  }

  /// The last frame that the page shows of a drive, once all of it was read. Throws std::runtime_error with
  /// what the command wrote, if it ends before.
  json last_frame(const std::string& words) const {
    support::ChildProcess view = start("laneloom view --port 0 " + words, "view.log");
    wait_for_url(view);
    json summaries{{"complete", false}};
    while (!summaries.at("complete").get<bool>()) {
      if (!view.running()) throw std::runtime_error(text("view.log"));
      summaries = json::parse(answer("/recording?from=0"));
    }
    return json::parse(answer("/frame?number=" + std::to_string(summaries.at("frames").size() - 1)));
  }

  /// Waits until the view has printed its URL, or has ended.
  void wait_for_url(support::ChildProcess& view) const {
    while (view.running() && text("view.log").find("http://") == std::string::npos) std::this_thread::yield();
  }
  std::uint16_t port() const {
    const std::string url = text("view.log").substr(text("view.log").find("http://"));
    return static_cast<std::uint16_t>(std::stoi(url.substr(url.find(':', 7) + 1)));
  }

  /// A recording of a service that needs more evidence of a line than by default.
  void record_service(const ServiceStatus& status) const {
    std::ofstream(file("strict.yaml")) << "mapper: {fusion: {confirm_log_odds: 2.5}}";
    ASSERT_TRUE(done("replay in.frames.jsonl --config strict.yaml --out maps.mcap"));
    std::vector<recording::RawMessage> messages;
    for (const char* part : {"in.mcap", "maps.mcap"}) {
      recording::RecordingReader reader(file(part));
      while (auto message = reader.next_raw()) messages.push_back(*std::move(message));
    }
    std::ranges::stable_sort(messages, {}, &recording::RawMessage::log_time_ns);
    recording::RecordingWriter out(file("live.mcap"));
    out.write(status, 5);
    for (const recording::RawMessage& message : messages) out.write_raw(message);
    out.close();
  }

 private:
  std::string answer(const std::string& target) const {
    Client client(port());
    client.send("GET " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    const std::string answer = client.receive_all();
    return answer.substr(answer.find("\r\n\r\n") + 4);
  }
};

TEST_F(ViewCommand, AServicesMapsAreExplainedWithItsConfiguration) {
  Config config;
  config.mapper.fusion.confirm_log_odds = 2.5;
  record_service({.published_ns = 5, .configuration = config::settings(config)});
  EXPECT_EQ(last_frame("live.mcap").at("why").at("confirm"), 2.5);
  ASSERT_TRUE(done("replay live.mcap --explain 3@5"));
  EXPECT_THAT(output(), HasSubstr("2.50 are needed"));
  ASSERT_TRUE(done("replay live.mcap --explain 3@5 --config $CONFIG/laneloom.yaml"));
  EXPECT_THAT(output(), HasSubstr("2.00 are needed")) << "as it would have been";
}

TEST_F(ViewCommand, ARecordingWithoutMapsIsMapped) {
  EXPECT_EQ(last_frame("in.mcap").at("why").at("confirm"), 2.0);
}

TEST_F(ViewCommand, APortThatIsTakenIsToldBeforeTheDriveIsRead) {
  support::ChildProcess first = start("laneloom view --port 0 in.mcap", "view.log");
  wait_for_url(first);
  ASSERT_EQ(shell("mkfifo endless.frames.jsonl"), 0);  // whoever reads it waits
  EXPECT_EQ(run("view endless.frames.jsonl --port " + std::to_string(port())), 1);
  EXPECT_THAT(output(), HasSubstr(std::to_string(port())));
}

TEST_F(ViewCommand, MapsOfAnUnknownConfigurationAreShownWithoutReasons) {
  record_service({.published_ns = 5, .configuration = {{"mapper.unheard_of", "1"}}});
  EXPECT_FALSE(last_frame("live.mcap").contains("why"));
  EXPECT_THAT(text("view.log"), HasSubstr("mapper.unheard_of: is not a known key; the view cannot tell why"));
  EXPECT_EQ(run("replay live.mcap --explain 3@5"), 1);
  EXPECT_THAT(output(), HasSubstr("mapper.unheard_of"));
}

}  // namespace
}  // namespace laneloom
