#include "session/pending_messages.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "laneloom/objects.hpp"
#include "milliseconds.hpp"

namespace laneloom::session {
namespace {

using Keys = std::vector<std::pair<std::int64_t, std::uint64_t>>;

class PendingMessagesTest : public ::testing::Test {
 protected:
  /// The newest pose is of 10 s.
  std::string_view add(std::int64_t stamp_ms, std::uint64_t session = 1) {
    return pending_.add({.stamp_ns = stamp_ms * kMs, .session_id = session}, 10'000 * kMs);
  }
  /// Stamps, in milliseconds, and sessions of what is taken.
  Keys take_until(std::int64_t stamp_ms) {
    Keys keys;
    while (const auto objects = pending_.take_until(stamp_ms * kMs))
      keys.emplace_back(objects->stamp_ns / kMs, objects->session_id);
    return keys;
  }

  PendingMessages<TrackedObjects> pending_{Config{}};
};

TEST_F(PendingMessagesTest, AreTakenInTheOrderOfStampsAndSessions) {
  for (const auto& [stamp_ms, session] : Keys{{9'300, 1}, {9'100, 2}, {9'400, 1}, {9'100, 1}, {9'200, 2}})
    EXPECT_EQ(add(stamp_ms, session), "");
  EXPECT_EQ(take_until(9'300), (Keys{{9'100, 1}, {9'100, 2}, {9'200, 2}, {9'300, 1}}));
  EXPECT_EQ(pending_.size(), 1U) << "it is newer than the frame";
}

TEST_F(PendingMessagesTest, OlderOnesThanThoseOfTheirSessionThatWereTakenAreRefused) {
  EXPECT_EQ(add(9'200), "");
  EXPECT_EQ(add(9'200), "repeated");
  take_until(9'500);
  EXPECT_EQ(add(9'200), "repeated");
  EXPECT_EQ(add(9'100), "late");
  EXPECT_EQ(add(9'100, 2), "") << "another tracker";
  EXPECT_EQ(add(9'300), "") << "it is older than the frame, but goes on from those that were taken";
  pending_.clear();
  EXPECT_EQ(add(9'100), "") << "all begins anew";
}

TEST_F(PendingMessagesTest, AStampFarAheadOfThePosesIsRefused) {
  EXPECT_EQ(add(11'900), "");
  EXPECT_EQ(add(12'100), "outlier");
  EXPECT_EQ(pending_.add({.stamp_ns = 1}, std::nullopt), "unsynchronised");
}

TEST_F(PendingMessagesTest, AreBounded) {
  for (int i = 0; i < 70; ++i) EXPECT_EQ(add(9'000 + i), "");
  EXPECT_EQ(pending_.drop_excess(), 6U);
  EXPECT_EQ(take_until(9'006), (Keys{{9'006, 1}})) << "the oldest were dropped";
}

}  // namespace
}  // namespace laneloom::session
