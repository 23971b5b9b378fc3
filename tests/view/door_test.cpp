#include "view/door.hpp"

#include <gtest/gtest.h>

namespace laneloom::view {
namespace {

Knock from(std::string_view host, std::string_view origin = "") {
  return {.method = "GET", .target = "/", .host = host, .origin = origin};
}

TEST(Door, OpensToItsOwnPages) {
  const Door door("127.0.0.1", "");
  for (const char* host : {"127.0.0.1:8642", "localhost:8642", "localhost", "[::1]:8642", "127.0.0.1:9000"}) {
    EXPECT_EQ(door.judge(from(host)), 200U) << host;
    EXPECT_EQ(door.judge(from(host, std::string("http://") + host)), 200U) << host;
  }
}

TEST(Door, RefusesForeignHosts) {
  const Door door("127.0.0.1", "");
  for (const char* host :
       {"", "evil.example", "evil.example:8642", "127.0.0.1.evil.example", "localhost.evil.example",
        "127.evil.example", "[::1", "[", "192.0.2.1:8642", "0.0.0.0:8642"})
    EXPECT_EQ(door.judge(from(host)), 403U) << host;
}

TEST(Door, RefusesForeignOrigins) {
  const Door door("127.0.0.1", "");
  for (const char* origin : {"http://evil.example", "null", "http://localhost:3000", "https://localhost:8642",
                             "http://localhost:8642.evil.example", "http://127.0.0.1:8642"})
    EXPECT_EQ(door.judge(from("localhost:8642", origin)), 403U) << origin;
}

TEST(Door, LetsProgramsOfAllowedOriginsHaveTheirStreamAlone) {
  const Door door("127.0.0.1", "", {"https://app.foxglove.dev"});
  Knock knock = from("localhost:8642", "https://app.foxglove.dev");
  EXPECT_EQ(door.judge(knock), 403U);
  knock.is_for_programs = true;
  EXPECT_EQ(door.judge(knock), 200U);
  for (const char* origin : {"https://app.foxglove.dev.evil.example", "http://app.foxglove.dev", "null"}) {
    knock.origin = origin;
    EXPECT_EQ(door.judge(knock), 403U) << origin;
  }
  knock = from("evil.example", "https://app.foxglove.dev");
  knock.is_for_programs = true;
  EXPECT_EQ(door.judge(knock), 403U);
}

TEST(Door, OnlyGets) {
  const Door door("127.0.0.1", "");
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "HEAD", "CONNECT", "get", ""}) {
    Knock knock = from("localhost:8642");
    knock.method = method;
    EXPECT_EQ(door.judge(knock), 405U) << method;
  }
}

TEST(Door, TakesFilesWhereNoOtherHostReachesIt) {
  Knock knock = from("localhost:8642", "http://localhost:8642");
  knock.is_file = true;
  EXPECT_EQ(Door("127.0.0.1", "").judge(knock), 405U) << "a GET brings none";
  knock.method = "PUT";
  EXPECT_EQ(Door("127.0.0.1", "").judge(knock), 200U);
  for (const char* address : {"0.0.0.0", "::", "192.0.2.1"}) {
    knock.host = address;
    knock.origin = "";
    knock.authorization = "Bearer secret";
    EXPECT_EQ(Door(address, "secret").judge(knock), 403U) << address;
  }
}

TEST(Door, OnEveryAddressTakesNumbersButNoNames) {
  const Door door("0.0.0.0", "secret");
  Knock knock = from("192.0.2.1:8642");
  knock.target = "/?token=secret";
  EXPECT_EQ(door.judge(knock), 200U);
  knock.host = "evil.example:8642";
  EXPECT_EQ(door.judge(knock), 403U);
}

TEST(Door, AsksForTheToken) {
  const Door door("192.0.2.1", "secret");
  Knock knock = from("192.0.2.1:8642");
  EXPECT_EQ(door.judge(knock), 401U);
  for (const char* target :
       {"/?token=", "/?token=secres", "/?token=secret1", "/?t=secret", "/?atoken=secret", "/secret"}) {
    knock.target = target;
    EXPECT_EQ(door.judge(knock), 401U) << target;
  }
  knock.target = "/live?a=b&token=secret";
  EXPECT_EQ(door.judge(knock), 200U);
  knock.target = "/";
  knock.cookie = "a=b; laneloom_view=secret";
  EXPECT_EQ(door.judge(knock), 200U);
  knock.cookie = "laneloom_viewer=secret; laneloom_view";
  EXPECT_EQ(door.judge(knock), 401U);
  knock.authorization = "Bearer secret";
  EXPECT_EQ(door.judge(knock), 200U);
}

TEST(Door, TellsTargetsApart) {
  const Target target("/frame?number=7&speed=2");
  EXPECT_EQ(target.path, "/frame");
  EXPECT_EQ(target.value("number"), "7");
  EXPECT_EQ(target.value("speed"), "2");
  EXPECT_EQ(target.value("peed"), "");
  EXPECT_EQ(Target("/").path, "/");
  EXPECT_EQ(Target("").path, "");
}

TEST(Door, TokensDiffer) {
  EXPECT_EQ(random_token().size(), 32U);
  EXPECT_NE(random_token(), random_token());
}

TEST(Door, KnowsWhatOnlyThisHostReaches) {
  EXPECT_TRUE(is_loopback("127.0.0.1"));
  EXPECT_TRUE(is_loopback("127.9.9.9"));
  EXPECT_TRUE(is_loopback("::1"));
  for (const char* address : {"0.0.0.0", "192.0.2.1", "::", "127.evil.example", ""})
    EXPECT_FALSE(is_loopback(address));
}

}  // namespace
}  // namespace laneloom::view
