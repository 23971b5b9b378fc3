#include "dds/self_probe.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <vector>

#include "dds/guarded_transport.hpp"
#include "dds/rtps_guard.hpp"

// What a service does that hears nothing any more is tried in tests/end_to_end/process_faults_test.cpp.
namespace laneloom::dds {
namespace {

/// A port of this host, and what comes to it.
class OpenPort {
 public:
  OpenPort() : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof here;
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&here), size) != 0 ||
        getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size) != 0)
      throw std::runtime_error("no port is free");
    number_ = ntohs(here.sin_port);
  }
  ~OpenPort() { close(socket_); }
  OpenPort(const OpenPort&) = delete;
  OpenPort& operator=(const OpenPort&) = delete;

  std::uint16_t number() const { return number_; }
  /// The next datagram; an empty one if none comes within a minute.
  std::vector<std::uint8_t> next() const {
    constexpr int kPatience_ms = 60'000;
    pollfd event{socket_, POLLIN, 0};
    std::vector<std::uint8_t> bytes(65536);
    const ssize_t size = poll(&event, 1, kPatience_ms) > 0 ? recv(socket_, bytes.data(), bytes.size(), 0) : 0;
    bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return bytes;
  }

 private:
  int socket_;
  std::uint16_t number_ = 0;
};

TEST(SelfProbe, CountsWhatAPortDoesNotTake) {
  const OpenPort one, other;
  SelfProbe probe;
  for (const OpenPort* port : {&one, &other}) probe.add_port({htonl(INADDR_LOOPBACK)}, port->number());
  for (int i = 0; i < 5; ++i) EXPECT_EQ(probe.ask().unanswered, 0) << "there may be no way to the ports";
  probe.note_taken(one.number());
  for (int i = 0; i < 5; ++i) EXPECT_EQ(probe.ask().unanswered, i);
  probe.note_taken(other.number());
  EXPECT_EQ(probe.ask().unanswered, 5);
  probe.note_taken(one.number());
  EXPECT_EQ(probe.ask().unanswered, 1) << "the other one has not taken the last question";
}

// DDS may be limited to one network, which goes away.
TEST(SelfProbe, WhatCannotBeSentIsNotUnanswered) {
  SelfProbe probe;
  probe.add_port({inet_addr("192.0.2.1")}, 7410);  // reserved for documents: no host has it
  EXPECT_FALSE(probe.ask().address_gone) << "there never was a way to the port";
  probe.note_taken(7410);
  for (int i = 0; i < 5; ++i) {
    const SelfCheck found = probe.ask();
    EXPECT_TRUE(found.address_gone);
    EXPECT_EQ(found.unanswered, 0);
  }
}

std::vector<std::uint8_t> question_of(SelfProbe& probe) {
  const OpenPort port;
  probe.add_port({htonl(INADDR_LOOPBACK)}, port.number());
  probe.ask();
  return port.next();
}

TEST(SelfProbe, ItsQuestionsAreSound) {
  SelfProbe probe;
  const auto question = question_of(probe);
  ASSERT_FALSE(question.empty());
  EXPECT_FALSE(RtpsGuard().check(question, 1));
}

TEST(SelfProbe, ItsQuestionsComeThroughTheDoorOfItsParticipantOnly) {
  for (const bool wants_protection : {false, true}) {
    Door door(wants_protection), other(wants_protection);
    const auto question = question_of(door.probe());
    ASSERT_FALSE(question.empty());
    EXPECT_TRUE(door.lets_in(question));
    EXPECT_TRUE(door.refused().values().empty());
    EXPECT_EQ(other.lets_in(question), !wants_protection) << "to the other one it is a stranger's";
  }
}

TEST(SelfProbe, WhatResemblesItsQuestionsIsRefusedWhereAllMustBeProtected) {
  Door door(true);
  const auto question = question_of(door.probe());
  ASSERT_FALSE(question.empty());
  auto longer = question;
  longer.push_back(0);
  EXPECT_FALSE(door.lets_in(longer));
  for (std::size_t i = 0; i < question.size(); ++i) {
    auto changed = question;
    changed[i] ^= 1U;
    EXPECT_FALSE(door.lets_in(changed)) << "byte " << i;
  }
}

}  // namespace
}  // namespace laneloom::dds
