#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>

#include "cdr/message_of.hpp"
#include "cdr/random_messages.hpp"
#include "cdr/serialise.hpp"
#include "message_json.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/recording.hpp"
#include "recording/topics.hpp"
#include "temporary_folder.hpp"

// Readers and writers that share no code with ours: npm's @mcap/core, @foxglove/omgidl-parser and
// -serialization.
namespace laneloom::recording {
namespace {

const std::string kFolder = INDEPENDENT_FOLDER;

class Independent : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder + "/node_modules/@mcap/core"))
      GTEST_SKIP() << "the npm registry could not be reached (see the test independent_install)";
  }

  /// Its exit code; what it says is in `output`.
  int run(const std::string& script, const std::string& arguments) {
    const std::string log = folder_.file("output");
    const int status =
        std::system(("node " + kFolder + "/" + script + " " + arguments + " >" + log + " 2>&1").c_str());
    const auto bytes = bytes_of(log);
    output_.assign(bytes.begin(), bytes.end());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  TemporaryFolder folder_;
  std::string output_;
};

/// Random messages of every topic, in a recording and as JSON lines.
class RandomRecording {
 public:
  RandomRecording(const TemporaryFolder& folder, Compression compression)
      : recording_(folder.file("r.mcap"), {.compression = compression, .chunk_bytes = 20'000}),
        expected_(folder.file("expected.jsonl")) {
    for (unsigned seed = 0; seed < 60; ++seed) {
      // Log times jump, so that chunks overlap, but no two are equal.
      const std::int64_t log_time_ns = 1'700'000'000'000'000'000 + (seed * 7919 % 60) * 1000;
      switch (seed % 7) {
        case 0:
          write<DetectionFrame>(seed, log_time_ns);
          break;
        case 1:
          write<VehiclePose>(seed, log_time_ns);
          break;
        case 2:
          write<PublishedMap>(seed, log_time_ns);
          break;
        case 3:
          write<RoadMarkings>(seed, log_time_ns);
          break;
        case 4:
          write<TrackedObjects>(seed, log_time_ns);
          break;
        case 5:
          write<NextTurn>(seed, log_time_ns);
          break;
        default:
          write<ServiceStatus>(seed, log_time_ns);
      }
    }
    recording_.close();
  }

  std::string arguments() const { return recording_.path() + " " + path_of_expected(); }

 private:
  std::string path_of_expected() const {
    return std::filesystem::path(recording_.path()).parent_path() / "expected.jsonl";
  }

  template <class T>
  void write(unsigned seed, std::int64_t log_time_ns) {
    dds::MessageOf<T> message;
    dds::RandomMessages(seed).fill(message);
    Bytes bytes;
    dds::serialise(message, bytes);
    dds::deserialise(bytes, message);  // its header has the checksum now
    recording_.write_cdr<T>(bytes, log_time_ns);
    expected_ << nlohmann::json{{"topic", topic_of<T>().name},
                                {"type", topic_of<T>().type},
                                {"log_time", std::to_string(log_time_ns)},
                                {"publish_time", std::to_string(message.header().stamp_ns())},
                                {"sequence", static_cast<std::uint32_t>(message.header().sequence_number())},
                                {"message", json_of(message)}}
              << std::endl;
  }

  RecordingWriter recording_;
  std::ofstream expected_;
};

TEST_F(Independent, ReadersFindEveryFieldEqual) {
  for (const auto compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    const TemporaryFolder folder;
    const RandomRecording recording(folder, compression);
    EXPECT_EQ(run("compare.mjs", recording.arguments()), 0) << output_.substr(0, 4000);
    EXPECT_NE(output_.find("60 messages with"), std::string::npos) << output_;
  }
}

// The comparison itself: one field that differs is found.
TEST_F(Independent, ReadersFindAFieldThatDiffers) {
  const RandomRecording recording(folder_, Compression::zstd);
  const auto bytes = bytes_of(folder_.file("expected.jsonl"));
  std::string text(bytes.begin(), bytes.end());
  const auto at = text.find("\"existence_probability\":");
  ASSERT_NE(at, std::string::npos);
  text.insert(at + 24, text[at + 24] == '-' ? "-1" : "1");
  if (text[at + 26] == '-') text.erase(at + 26, 1);
  std::ofstream(folder_.file("expected.jsonl")) << text;
  EXPECT_NE(run("compare.mjs", recording.arguments()), 0);
  EXPECT_NE(output_.find("existence_probability"), std::string::npos) << output_;
}

TEST_F(Independent, FilesOfAnotherWriterAreRead) {
  ASSERT_EQ(run("write.mjs", folder_.path()), 0) << output_;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    if (entry.path().extension() != ".mcap") continue;
    ++files;
    SCOPED_TRACE(entry.path());
    McapReader reader(entry.path());
    EXPECT_FALSE(reader.cut_off());
    std::vector<bool> seen(1000);
    std::uint64_t time_ns = 0;
    while (const auto message = reader.next()) {
      EXPECT_GE(message->log_time_ns, time_ns);
      time_ns = message->log_time_ns;
      const std::string text(message->data.begin(), message->data.end());
      const auto i = std::stoul(text);
      EXPECT_EQ(message->sequence, i);
      EXPECT_EQ(message->publish_time_ns, i);
      EXPECT_EQ(message->channel->topic, i % 2 == 0 ? "even" : "odd");
      EXPECT_EQ(message->channel->schema != nullptr, i % 2 == 0);
      seen.at(i) = true;
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 1000);
  }
  EXPECT_EQ(files, 10);
}

}  // namespace
}  // namespace laneloom::recording
