#include "bench/worst_frames.hpp"

#include <gtest/gtest.h>

#include <string>

#include "laneloom/dds/cdr.hpp"
#include "session/admission.hpp"
#include "session/gate.hpp"

namespace laneloom::bench {
namespace {

// Else it would not be the worst that a service can get.
TEST(WorstFrames, FillAMessageAndPassTheGate) {
  for (const WorstKind kind : kWorstKinds) {
    DetectionFrame frame = worst_frame(kind, 3);
    frame.stamp_ns = 1;
    EXPECT_EQ(frame.detections.size(), 512U) << name(kind);
    EXPECT_EQ(session::defect(frame, GateConfig{}), "") << name(kind);
    std::vector<std::uint8_t> bytes;
    EXPECT_EQ(dds::to_cdr(frame, "map", bytes), 0U) << name(kind);
  }
}

TEST(WorstFrames, AreThinnedToTheBoundsOfTheGate) {
  const GateConfig gate;
  for (const WorstKind kind : kWorstKinds) {
    DetectionFrame frame = worst_frame(kind, 3);
    EXPECT_GT(session::admit(gate, frame), 0U) << name(kind);
    EXPECT_LE(frame.detections.size(), static_cast<std::size_t>(gate.max_frame_detections)) << name(kind);
    EXPECT_LE(session::length_of_markings(frame), gate.max_frame_length_m) << name(kind);
  }
}

TEST(WorstFrames, AreTimed) {
  const TimeSummary time = time_worst(Config{}, WorstKind::heap, 3);
  EXPECT_GT(time.max_ms, 0.0);
  EXPECT_LE(time.p50_ms, time.max_ms);
}

}  // namespace
}  // namespace laneloom::bench
