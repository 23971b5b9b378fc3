#include "stranger.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dds/participant_impl.hpp"
#include "faults.hpp"
#include "identities.hpp"

// One datagram of a stranger ends no service; config/security/README.md, "The guard at the door".
namespace laneloom {
namespace {

dds::Prefix prefix_of(const dds::Participant& participant) {
  const auto* const dds = participant.impl()->publisher().get_participant();
  dds::Prefix result{};
  std::copy_n(dds->guid().guidPrefix.value, result.size(), result.begin());
  return result;
}

/// A process that has lived so far ends when it is told to.
::testing::AssertionResult ends_in_order(Process& process) {
  process.signal(SIGTERM);
  if (process.wait() == 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << process.errors();
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

// Fast DDS 2.9 reads as many representations as it is told, and takes memory for each.
TEST_F(Strangers, AnAnnouncementWithoutEndDoesNotEndTheService) {
  start();
  const dds::Participant peer(config_, "peer");
  const dds::Writer<VehiclePose> writer(peer);
  ASSERT_TRUE(is_good_again());
  const dds::Prefix name = prefix_of(peer);
  const dds::Packet endless = dds::reader_with_representations(0xffffffff);
  const auto before = counters();
  stranger_.send(dds::announced_whole(name, 1, endless));
  EXPECT_TRUE(rises("datagrams_refused_parameters", before));
  const auto after_the_first = counters();
  for (const std::uint32_t n : {1U, 2U, 3U}) stranger_.send(dds::announced_fragment(name, 1, endless, n));
  EXPECT_TRUE(rises("datagrams_refused_parameters", after_the_first));
  EXPECT_TRUE(stays_good(40));
  EXPECT_TRUE(service_finds_a_newcomer());
}

/// The command of a stranger in the domain of a test. tools/check-all tells by the environment to send more.
std::vector<std::string> stranger(int domain, const std::vector<std::string>& captures) {
  const char* const datagrams = std::getenv("LANELOOM_DATAGRAMS");
  std::vector<std::string> command{STRANGER, std::to_string(domain), datagrams ? datagrams : "100000", "1"};
  for (const auto& name : captures) command.push_back(LANELOOM_CAPTURES "/" + name + ".pcap");
  return command;
}

/// The exit code of a process that may take long.
int end_of(Process& process) {
  std::optional<int> end;
  while (!end) end = process.wait();
  return *end;
}

TEST_F(Strangers, DamagedTrafficEndsNothing) {
  start();
  Process damaging(stranger(config_.domain, {"laneloom", "fast_dds", "cyclone", "ros"}));
  EXPECT_EQ(end_of(damaging), 0) << damaging.errors();
  // What he said in the name of participants of this test is believed, but not for others.
  road_ = std::make_unique<StraightRoad>(config_);
  EXPECT_TRUE(service_finds_a_newcomer());
  EXPECT_TRUE(ends_in_order(*service_));
}

TEST(SecuredStrangers, DamagedTrafficEndsNothing) {
  const Identities identities;
  const auto as = [&, config = private_config()](const std::string& name) {
    return identities.as(name, config);
  };
  Service service(as("service"));
  {
    Listener<PublishedMap> maps(as("pnc"));
    const StraightRoad road(as("simulator"));
    ASSERT_TRUE(maps.wait_for(is_good)) << service.errors();
    Process damaging(stranger(as("pnc").domain, {"secured", "laneloom", "fast_dds"}));
    EXPECT_EQ(end_of(damaging), 0) << damaging.errors();
  }
  Listener<PublishedMap> maps(as("pnc"));
  const StraightRoad road(as("simulator"));
  EXPECT_TRUE(maps.wait_for(is_good)) << service.errors();
  EXPECT_TRUE(ends_in_order(service));
}

}  // namespace
}  // namespace laneloom
