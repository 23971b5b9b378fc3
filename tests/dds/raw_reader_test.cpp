#include "laneloom/dds/raw_reader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>

#include "laneloom/dds/cdr.hpp"
#include "laneloom/dds/writer.hpp"
#include "laneloom/messages.hpp"
#include "own_domain.hpp"

namespace laneloom::dds {
namespace {

using Bytes = std::vector<std::uint8_t>;

DetectionFrame whole_frame(std::uint64_t sequence) {
  DetectionFrame frame{.stamp_ns = 5, .sequence = sequence, .session_id = 7, .source = "test"};
  frame.detections.push_back(Detection{.confidence = 0.5, .points = {{0, 0, 0}, {1, 2, 3}}});
  return frame;
}

TEST(RawReader, MessagesComeAsTheyWentOverTheWire) {
  std::mutex mutex;
  std::condition_variable arrived;
  std::vector<Bytes> messages;
  DdsConfig config;
  config.domain = own_domain();
  config.vehicle_id = "raw" + std::to_string(getpid());
  const Participant there(config, "there"), here(config, "here");
  const RawReader<DetectionFrame> reader(there, [&](const WriterId& /*writer*/, Bytes&& message) {
    const std::lock_guard lock(mutex);
    messages.push_back(std::move(message));
    arrived.notify_all();
    if (messages.size() == 1) throw std::runtime_error("this does no harm");
  });
  Writer<DetectionFrame> writer(here);
  const auto arrives = [&](std::uint64_t sequence, std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex);
    return arrived.wait_for(lock, patience, [&] {
      return !messages.empty() && header_of(messages.back()).value().sequence == sequence;
    });
  };
  // Messages that are written before the reader knows its writer are lost.
  for (int i = 0; i < 2000 && !arrives(0, std::chrono::milliseconds(10)); ++i)
    ASSERT_TRUE(writer.write(whole_frame(0)));
  ASSERT_TRUE(writer.write(whole_frame(1)) && writer.write(whole_frame(2)));
  ASSERT_TRUE(arrives(2, std::chrono::seconds(20)));

  const std::lock_guard lock(mutex);
  messages.erase(messages.begin(), messages.end() - 2);
  for (std::uint64_t i = 0; i < 2; ++i) {
    Bytes expected;
    EXPECT_EQ(to_cdr(whole_frame(i + 1), config.map_frame_id, expected), 0U);
    EXPECT_EQ(messages[i], expected);
    const auto header = header_of(messages[i]);
    ASSERT_TRUE(header);
    EXPECT_EQ(header->stamp_ns, 5);
    EXPECT_EQ(header->sequence, i + 1);
    EXPECT_EQ(header->session_id, 7U);
  }
}

}  // namespace
}  // namespace laneloom::dds
