#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "dds/captured_datagrams.hpp"
#include "dds/rtps_guard.hpp"

// What participants of each vendor send as they come; tests/dds/captures/record.
namespace laneloom::dds {
namespace {

std::vector<Packet> captured(const std::string& name) {
  return captured_datagrams(LANELOOM_CAPTURES "/" + name + ".pcap");
}

/// The kinds of submessages of all datagrams of a vendor.
std::set<int> kinds(const std::vector<Packet>& datagrams, std::uint8_t vendor) {
  std::set<int> result;
  for (const Packet& datagram : datagrams) {
    for (std::size_t at = 20; at + 4 <= datagram.size() && datagram[7] == vendor;) {
      result.insert(datagram[at]);
      at += 4 + datagram[at + 2] + 256U * datagram[at + 3];
    }
  }
  return result;
}

class Captures : public ::testing::TestWithParam<std::string> {};

TEST_P(Captures, NothingIsRefused) {
  RtpsGuard guard;
  for (const Packet& datagram : captured(GetParam())) {
    const auto refusal = guard.check(datagram, 1);
    EXPECT_FALSE(refusal) << kDatagramRefusals[static_cast<std::size_t>(*refusal)];
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Captures,
                         ::testing::Values("laneloom", "fast_dds", "cyclone", "ros", "ros_nodes", "secured"),
                         [](const auto& file) { return file.param; });

TEST(Captures, SecuredParticipantsProtectWhatTheyMust) {
  RtpsGuard guard(true);
  for (const Packet& datagram : captured("secured")) EXPECT_FALSE(guard.check(datagram, 1));
}

TEST(Captures, HaveTheSubmessagesThatVendorsSend) {
  const std::set<int> common{0x06, 0x07, 0x09, 0x0e, 0x12, 0x15, 0x16}, secured{0x30, 0x31, 0x32, 0x33, 0x34};
  const auto has = [](const std::set<int>& all, const std::set<int>& some) {
    return std::ranges::includes(all, some);
  };
  constexpr std::uint8_t kFastDds = 0x0f, kCyclone = 0x10;
  EXPECT_TRUE(has(kinds(captured("fast_dds"), kFastDds), common));
  EXPECT_TRUE(has(kinds(captured("cyclone"), kCyclone), common));
  EXPECT_TRUE(has(kinds(captured("ros"), kFastDds), {0x08}));
  EXPECT_TRUE(has(kinds(captured("secured"), kFastDds), secured));
}

}  // namespace
}  // namespace laneloom::dds
