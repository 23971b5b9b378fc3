#include "view/stream.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "view/foxglove_stream.hpp"

namespace laneloom::view {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

std::shared_ptr<const std::string> body(const std::string& text) {
  return std::make_shared<const std::string>(text);
}
WebMessage message(const std::string& text) { return {.header = {}, .body = body(text)}; }

std::vector<std::string> bodies(Outbox& outbox) {
  std::vector<std::string> out;
  while (const auto next = outbox.next()) out.push_back(*next->body);
  return out;
}

TEST(Outbox, KeepsTheNewestOfEachSlotInItsPlace) {
  Outbox outbox;
  outbox.put(1, message("a"));
  outbox.put(2, message("b"));
  outbox.put(1, message("c"));
  EXPECT_THAT(bodies(outbox), ElementsAre("c", "b"));
  EXPECT_THAT(bodies(outbox), IsEmpty());
}

TEST(PageStream, GivesItsChannelAlone) {
  PageStream stream(1);
  Outbox outbox;
  stream.open({{}, {}}, outbox);
  EXPECT_THAT(bodies(outbox), IsEmpty());
  const Publication wanted{.channel = 1, .body = body("wanted")}, other{.channel = 0, .body = body("other")};
  stream.open({other, wanted}, outbox);
  EXPECT_THAT(bodies(outbox), ElementsAre("wanted"));
  stream.publish(other, outbox);
  EXPECT_THAT(bodies(outbox), IsEmpty());
}

TEST(FoxgloveSubprotocol, TheNewestIsPreferred) {
  EXPECT_EQ(foxglove_subprotocol("foxglove.websocket.v1, foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(foxglove_subprotocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(foxglove_subprotocol("chat,foxglove.sdk.v1"), "foxglove.sdk.v1");
  for (const char* none : {"", "foxglove", "foxglove.sdk.v10", ",,", "foxglove.sdk"})
    EXPECT_EQ(foxglove_subprotocol(none), "") << none;
}

class Foxglove : public testing::Test {
 protected:
  bool send(const json& text) { return stream_.receive(text.dump(), newest_, outbox_); }
  bool subscribe(const json& id, const json& channel) {
    return send({{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}});
  }
  void publish(std::size_t channel, std::int64_t time_ns, const std::string& text) {
    newest_[channel] = {channel, time_ns, body(text)};
    stream_.publish(newest_[channel], outbox_);
  }

  FoxgloveGreeting greeting_{{{"/scene", "A", "struct A {};"}, {"/tf", "B", "struct B {};"}}, 1, "session"};
  FoxgloveStream stream_{greeting_};
  NewestPublications newest_{3};
  Outbox outbox_;
};

TEST_F(Foxglove, SaysWhatThereIs) {
  stream_.open(newest_, outbox_);
  const auto texts = bodies(outbox_);
  ASSERT_EQ(texts.size(), 2U);
  const json info = json::parse(texts[0]), advertise = json::parse(texts[1]);
  EXPECT_EQ(info["op"], "serverInfo");
  EXPECT_EQ(info["sessionId"], "session");
  EXPECT_EQ(info["capabilities"], json::array());
  EXPECT_EQ(advertise["op"], "advertise");
  EXPECT_EQ(advertise["channels"][1], (json{{"id", 2},
                                            {"topic", "/tf"},
                                            {"encoding", "cdr"},
                                            {"schemaName", "B"},
                                            {"schema", "struct B {};"},
                                            {"schemaEncoding", "omgidl"}}));
}

TEST_F(Foxglove, GivesWhatIsSubscribedWithTimeAndSubscription) {
  publish(1, 0x0102030405060708, "scene");
  EXPECT_THAT(bodies(outbox_), IsEmpty());
  EXPECT_TRUE(subscribe(0x01020304, 1));
  const auto latest = outbox_.next();
  ASSERT_TRUE(latest);
  EXPECT_TRUE(latest->binary);
  EXPECT_EQ(latest->header, std::string("\x01\x04\x03\x02\x01\x08\x07\x06\x05\x04\x03\x02\x01", 13));
  EXPECT_EQ(*latest->body, "scene");
  publish(2, 1, "transform");
  publish(1, 2, "next scene");
  EXPECT_THAT(bodies(outbox_), ElementsAre("next scene"));
  EXPECT_TRUE(send({{"op", "unsubscribe"}, {"subscriptionIds", {0x01020304, 5, "x"}}}));
  publish(1, 3, "later scene");
  EXPECT_THAT(bodies(outbox_), IsEmpty());
}

TEST_F(Foxglove, SaysThatThereIsNoSuchChannel) {
  for (const json& channel : {json(0), json(3), json(4294967295)}) {
    EXPECT_TRUE(subscribe(7, channel));
    const auto texts = bodies(outbox_);
    ASSERT_EQ(texts.size(), 1U);
    EXPECT_EQ(json::parse(texts[0])["op"], "status");
  }
}

TEST_F(Foxglove, LimitsSubscriptions) {
  publish(1, 1, "scene");
  for (int id = 0; id < 1000; ++id) EXPECT_TRUE(subscribe(id, 1));
  EXPECT_EQ(bodies(outbox_).size(), 64U + 1U);  // and a complaint
  EXPECT_TRUE(subscribe(63, 2));                // of one that there is
}

TEST_F(Foxglove, PassesOverWhatIsNotOfferedAndRefusesWhatIsNoMessage) {
  EXPECT_TRUE(send({{"op", "getParameters"}, {"parameterNames", json::array()}}));
  EXPECT_TRUE(send({{"op", "subscribe"}}));
  EXPECT_TRUE(send({{"op", 7}}));
  for (const char* text : {"", "{", "[]", "7", "{}", R"({"subscriptions": []})", "\xff"})
    EXPECT_FALSE(stream_.receive(text, newest_, outbox_)) << text;
  for (const json& wrong : {json(-1), json(1.5), json("1"), json(4294967296), json()})
    EXPECT_FALSE(subscribe(wrong, 1)) << wrong;
  EXPECT_FALSE(send({{"op", "subscribe"}, {"subscriptions", {7}}}));
  EXPECT_THAT(bodies(outbox_), IsEmpty());
}

}  // namespace
}  // namespace laneloom::view
