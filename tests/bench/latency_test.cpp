#include "bench/latency.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include "own_domain.hpp"
#include "support/publication_log.hpp"
#include "temporary_folder.hpp"

namespace laneloom::bench {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::int64_t kMillisecond = 1'000'000;

class LogFile : public testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(file_) << text; }

  const TemporaryFolder folder_;
  const std::string file_ = folder_.file("log");
};

TEST(Latencies, AreFromTickAndPublicationToTheCallback) {
  const std::vector<LoggedTick> ticks{
      {.map = 7, .start_ns = 100 * kMillisecond, .delay_ns = kMillisecond, .missed = 0},
      {.map = 8, .start_ns = 200 * kMillisecond, .delay_ns = 3 * kMillisecond, .missed = 2},
      {.map = 9, .start_ns = 500 * kMillisecond, .delay_ns = 2 * kMillisecond, .missed = 0}};
  const std::vector<ReceivedMap> maps{{.sequence = 6,
                                       .published_ns = 1,
                                       .callback_ns = 2,
                                       .fused_frames = {40}},  // of a tick that is not asked for
                                      {.sequence = 7,
                                       .published_ns = 102 * kMillisecond,
                                       .callback_ns = 103 * kMillisecond,
                                       .fused_frames = {41, 42}},
                                      {.sequence = 9,
                                       .published_ns = 501 * kMillisecond,
                                       .callback_ns = 505 * kMillisecond,
                                       .fused_frames = {43, 44}}};
  const std::map<std::uint64_t, std::int64_t> published{
      {40, 0}, {41, 3 * kMillisecond}, {42, 53 * kMillisecond}, {43, 405 * kMillisecond}};
  const LatencyResult result = latencies(ticks, maps, published);
  EXPECT_EQ(result.ticks, 3U);
  EXPECT_EQ(result.missed_deadlines, 2U);
  EXPECT_EQ(result.maps_lost, 1U);
  EXPECT_DOUBLE_EQ(result.tick_delay.mean_ms, 2.0);
  EXPECT_DOUBLE_EQ(result.tick_delay.max_ms, 3.0);
  EXPECT_DOUBLE_EQ(result.tick_to_callback.p50_ms, 3.0);
  EXPECT_DOUBLE_EQ(result.tick_to_callback.p99_ms, 5.0);
  EXPECT_DOUBLE_EQ(result.publication_to_callback.mean_ms, 2.5);
  EXPECT_EQ(result.frames, 3U);  // 44 was published by somebody else
  EXPECT_DOUBLE_EQ(result.detections_to_callback.mean_ms, (100.0 + 50.0 + 100.0) / 3.0);
}

TEST_F(LogFile, TicksAreReadFromTheServicesLog) {
  write(
      "2025-01-01T00:00:00.000Z info event=started version=1\n"
      "2025-01-01T00:00:00.100Z debug event=tick map=3 start_ns=1700000000000000001 delay_ns=52000 missed=0\n"
      "2025-01-01T00:00:00.100Z info state=OK session=1\n"
      "2025-01-01T00:00:00.400Z debug event=tick map=4 start_ns=1700000000300000001 delay_ns=7 missed=2\n");
  const std::vector<LoggedTick> ticks = read_tick_log(file_);
  ASSERT_EQ(ticks.size(), 2U);
  EXPECT_EQ(ticks[0].map, 3U);
  EXPECT_EQ(ticks[0].start_ns, 1'700'000'000'000'000'001);
  EXPECT_EQ(ticks[0].delay_ns, 52'000);
  EXPECT_EQ(ticks[1].missed, 2U);
}

TEST_F(LogFile, AMalformedTickIsNamed) {
  write("x debug event=tick map=3 start_ns=1 delay_ns=? missed=0\n");
  EXPECT_THAT([&] { read_tick_log(file_); }, ThrowsMessage<std::runtime_error>(HasSubstr("delay_ns")));
  unlink(file_.c_str());
  EXPECT_THAT([&] { read_tick_log(file_); }, ThrowsMessage<std::runtime_error>(HasSubstr(file_)));
}

TEST_F(LogFile, PublicationsAreReadAsTheyWereWritten) {
  support::PublicationLogWriter writer(file_, 77);
  writer.add(1, 1'700'000'000'000'000'001);
  writer.add(2, 5);
  const std::map<std::uint64_t, std::int64_t> expected{{1, 1'700'000'000'000'000'001}, {2, 5}};
  const auto log = support::read_publication_log(file_);  // as if the writer had been killed
  EXPECT_EQ(log.session_id, 77U);
  EXPECT_EQ(log.times_ns, expected);
  writer.close();
  EXPECT_THROW(support::PublicationLogWriter("/nowhere/times.csv", 1), std::runtime_error);
}

TEST(MeasureLatency, NamesAServiceThatEndsByItself) {
  LatencySpec spec{
      .service = "/bin/false", .publisher = "/bin/false", .dds = {}, .scenario = "straight", .noise = "none"};
  spec.dds.domain = own_domain();
  EXPECT_THAT([&] { measure_latency(spec); }, ThrowsMessage<std::runtime_error>(HasSubstr("/bin/false")));
}

}  // namespace
}  // namespace laneloom::bench
