#include "view/black_box.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "config/config_file.hpp"
#include "temporary_folder.hpp"

namespace laneloom::view {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// The recording that a box saves, as a file of its own.
class Saved {
 public:
  explicit Saved(const BlackBox& box) : path_(folder_.file("saved.mcap")) {
    std::ofstream(path_, std::ios::binary) << box.mcap();
  }
  recording::RecordingReader reader() const { return recording::RecordingReader(path_); }

 private:
  TemporaryFolder folder_;
  std::string path_;
};

TEST(BlackBox, SavesTheLastMessagesWithTheConfiguration) {
  BlackBox box({}, {.span_s = 60.0});
  ServiceStatus status;
  Config changed;
  changed.mapper.range.side_max_m = 17.5;
  changed.dds.profile_file = "profiles.xml";  // valid with the next alone
  changed.dds.profile_name = "car";
  status.configuration = config::settings(changed);
  box.add(status, 0);
  DetectionFrame frame{.source = "network"};
  frame.detections.resize(100);
  for (Detection& detection : frame.detections) detection.points.resize(50, Point::Zero());
  for (int i = 0; i < 1000; ++i) {  // 100 s
    frame.stamp_ns = i * kSecond_ns / 10;
    box.add(frame, frame.stamp_ns);
  }
  const Saved saved(box);
  recording::RecordingReader reader = saved.reader();
  std::vector<std::int64_t> stamps_ns;
  while (const auto message = reader.next())
    if (const auto* read = std::get_if<DetectionFrame>(&message->message))
      stamps_ns.push_back(read->stamp_ns);
  ASSERT_FALSE(stamps_ns.empty());
  EXPECT_TRUE(std::ranges::is_sorted(stamps_ns));
  EXPECT_EQ(stamps_ns.back(), 999 * kSecond_ns / 10);
  EXPECT_NEAR(static_cast<double>(stamps_ns.front()), 40e9, 2e9);
  const recording::Origin origin = reader.origin();
  EXPECT_FALSE(origin.version.empty());
  const TemporaryFolder folder;
  std::ofstream(folder.file("config.yaml")) << origin.configuration;
  EXPECT_EQ(config::settings(config::load_config(folder.file("config.yaml"))), status.configuration);
}

TEST(BlackBox, WithoutAMessageThereIsAnEmptyRecording) {
  const Saved saved(BlackBox({}, {}));
  recording::RecordingReader reader = saved.reader();
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.origin().configuration, "");
}

}  // namespace
}  // namespace laneloom::view
