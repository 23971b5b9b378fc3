#include "endurance/account.hpp"

#include <gtest/gtest.h>

namespace laneloom::endurance {
namespace {

support::PublicationLog log(std::uint64_t session, std::uint64_t from, std::uint64_t to) {
  support::PublicationLog result{session, {}};
  for (auto sequence = from; sequence <= to; ++sequence) result.times_ns[sequence] = 1;
  return result;
}

const std::vector<support::PublicationLog> kLogs{log(1, 0, 99), log(2, 0, 49), log(3, 0, 9)};

TEST(Account, CountsWhatWasPublishedBetweenFirstAndLastSeen) {
  const std::vector<SourceStatus> sources{{"a", 1, 90, 99, 10}, {"a", 2, 0, 20, 20}, {"b", 7, 0, 5, 6}};
  EXPECT_EQ(account_of({}, sources, kLogs).published, 10U + 21U);
}

TEST(Account, ExplainsEveryFrame) {
  ServiceStatus status;
  status.pending_frames = 2;
  status.counters = {{"detections_lost", 1},           {"detections_received", 30},
                     {"detections_refused_late", 3},   {"detections_refused_reset", 1},
                     {"frames_dropped_queue_full", 4}, {"frames_fused", 20},
                     {"poses_refused_late", 100},      {"poses_lost", 5}};
  const std::vector<SourceStatus> sources{{"a", 1, 0, 30, 30}};
  const auto account = account_of(status, sources, kLogs);
  EXPECT_EQ(account.published, 31U);
  EXPECT_EQ(account.refused, 4U);
  EXPECT_EQ(account.unexplained(), 0);
  status.counters[5].second = 19;
  EXPECT_EQ(account_of(status, sources, kLogs).unexplained(), 1);
  status.counters[5].second = 22;
  EXPECT_EQ(account_of(status, sources, kLogs).unexplained(), -2);
}

}  // namespace
}  // namespace laneloom::endurance
