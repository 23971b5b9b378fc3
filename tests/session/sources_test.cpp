#include "session/sources.hpp"

#include <gtest/gtest.h>

namespace laneloom {
namespace {

constexpr std::int64_t kFrame_ns = 100'000'000;
constexpr std::int64_t kHour_ns = 3600 * std::int64_t{1'000'000'000};

DetectionFrame frame_at(std::int64_t stamp_ns, std::uint64_t session_id) {
  DetectionFrame frame;
  frame.stamp_ns = stamp_ns;
  frame.session_id = session_id;
  frame.source = "camera";
  return frame;
}

void fuse(const DetectionFrame& frame, Sources& sources) {
  if (sources.check(frame, frame.stamp_ns).refusal.empty()) sources.note_fused(frame, frame.stamp_ns);
}

TEST(Sources, CountsOnAfterAJumpOfTheStamps) {
  Sources sources{GateConfig{}};
  for (int i = 1; i <= 5; ++i) fuse(frame_at(i * kFrame_ns, 7), sources);
  for (int i = 1; i <= 5; ++i) fuse(frame_at(kHour_ns + i * kFrame_ns, 7), sources);
  ASSERT_EQ(sources.progress().size(), 1U);
  EXPECT_EQ(sources.progress()[0].fused, 8U) << "the first two after the jump are outliers";
  EXPECT_EQ(sources.progress()[0].session_id, 7U);
}

TEST(Sources, ANewSessionCountsFromZero) {
  Sources sources{GateConfig{}};
  for (int i = 1; i <= 5; ++i) fuse(frame_at(i * kFrame_ns, 7), sources);
  fuse(frame_at(6 * kFrame_ns, 8), sources);
  EXPECT_EQ(sources.progress()[0].fused, 1U);
  EXPECT_EQ(sources.progress()[0].session_id, 8U);
}

}  // namespace
}  // namespace laneloom
