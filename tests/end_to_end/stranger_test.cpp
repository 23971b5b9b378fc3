#include "stranger.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <random>
#include <string>
#include <vector>

#include "dds/participant_impl.hpp"
#include "faults.hpp"

// One datagram of a stranger ends no service; config/security/README.md, "The guard at the door".
namespace laneloom {
namespace {

dds::Prefix prefix_of(const dds::Participant& participant) {
  const auto* const dds = participant.impl()->publisher().get_participant();
  dds::Prefix result{};
  std::copy_n(dds->guid().guidPrefix.value, result.size(), result.begin());
  return result;
}

class Strangers : public Faults {
 protected:
  /// A participant that was not there before is found, by a service that goes on.
  ::testing::AssertionResult service_finds_a_newcomer() {
    Listener<PublishedMap> newcomer(config_);
    if (newcomer.wait_for(is_good, kPatience)) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << service_->errors();
  }

  const Stranger stranger_{config_.domain};
};

TEST_F(Strangers, NoneOfTheThreeDatagramsEndsTheService) {
  start();
  const dds::Participant peer(config_, "peer");
  const dds::Writer<VehiclePose> writer(peer);
  ASSERT_TRUE(is_good_again());
  const auto before = counters();
  EXPECT_FALSE(refused_datagrams(status_.samples().back()));
  stranger_.send(dds::vendor_submessage_in_the_midst());
  EXPECT_TRUE(rises("datagrams_refused_vendor", before));
  stranger_.send(dds::fragments_beyond_their_sample());
  EXPECT_TRUE(rises("datagrams_refused_fragments", before));
  stranger_.send(dds::heartbeat_that_leaps(prefix_of(peer), std::int64_t{1} << 62));
  EXPECT_TRUE(rises("datagrams_refused_sequence", before));
  stranger_.send(dds::heartbeat_that_leaps(prefix_of(peer), std::int64_t{1} << 38));
  EXPECT_TRUE(rises("datagrams_refused_leap", before));
  EXPECT_TRUE(stays_good(10));
  EXPECT_TRUE(service_finds_a_newcomer());
}

}  // namespace
}  // namespace laneloom
