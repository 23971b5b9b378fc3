#include "view/web_server.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "client.hpp"
#include "thrown_by.hpp"

namespace laneloom::view {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::StartsWith;

WebAnswer echo(std::string_view target) {
  if (target == "/fault") throw std::runtime_error("a fault of the handler");
  if (target == "/missing") return {404, "text/plain", "no"};
  return {200, "text/plain", "you asked for " + std::string(target)};
}

std::string get(const std::string& target, const std::string& more = "") {
  return "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n" + more + "\r\n";
}

std::string upgrade(const std::string& more = "") {
  return get("/live",
             "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n" +
                 more);
}

class Server : public testing::Test {
 protected:
  void start(WebServerConfig config = {}) { server_ = std::make_unique<WebServer>(config, echo); }
  Client client() const { return Client(server_->port()); }
  /// The server's answer to the bytes, until it ends the connection.
  std::string answer_to(const std::string& bytes) const {
    Client one = client();
    one.send(bytes);
    return one.receive_all();
  }

  std::unique_ptr<WebServer> server_;
};

TEST_F(Server, AnswersGets) {
  start();
  Client one = client();
  for (const char* target : {"/a", "/b?c=d"}) {  // over one connection
    one.send(get(target));
    const std::string answer = one.receive_until("you asked for " + std::string(target));
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(answer, HasSubstr("Content-Security-Policy: default-src 'none';"));
    EXPECT_THAT(answer, HasSubstr("X-Content-Type-Options: nosniff"));
    EXPECT_THAT(answer, Not(HasSubstr("Access-Control")));
  }
  one.send(get("/missing"));
  EXPECT_THAT(one.receive_until("no"), StartsWith("HTTP/1.1 404 Not Found\r\n"));
}

TEST_F(Server, RefusesWhatItMust) {
  start();
  EXPECT_THAT(answer_to("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer_to("GET / HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer_to(get("/", "Origin: http://evil.example\r\n")), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer_to(upgrade("Origin: http://evil.example\r\n")), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer_to("POST / HTTP/1.1\r\nHost: localhost\r\n\r\n"), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(answer_to("BREW / HTTP/1.1\r\nHost: localhost\r\n\r\n"), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(answer_to(get("/live")), StartsWith("HTTP/1.1 426"));
}

TEST_F(Server, AFaultOfTheHandlerIsAnAnswer) {
  start();
  EXPECT_THAT(answer_to(get("/fault")), StartsWith("HTTP/1.1 500"));
  EXPECT_THAT(answer_to(get("/a", "Connection: close\r\n")), StartsWith("HTTP/1.1 200"));
}

TEST_F(Server, RefusesMalformedAndOversizedRequests) {
  start();
  EXPECT_THAT(answer_to("\r\n\r\n\x01\x02\x03\r\n\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(answer_to("GET / HTTP/9.9\r\nHost: localhost\r\n\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(answer_to(get("/", "X: " + std::string(9000, 'x') + "\r\n")), StartsWith("HTTP/1.1 431"));
  EXPECT_THAT(answer_to(get("/" + std::string(9000, 'x'))), StartsWith("HTTP/1.1 431"));
  EXPECT_THAT(answer_to(get("/", "Content-Length: 5\r\n") + "hello"), StartsWith("HTTP/1.1 413"));
  client().send(get("/a"));  // and leaves without the answer
  Client one = client();
  one.send(get("/still there"));
  one.send(get("/b"));
  EXPECT_THAT(one.receive_all(), StartsWith("HTTP/1.1 400"));  // of the space in its target
  EXPECT_THAT(answer_to(get("/b", "Connection: close\r\n")), HasSubstr("you asked for /b"));
}

std::string put(const std::string& target, std::size_t bytes, const std::string& more = "") {
  return "PUT " + target +
         " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Length: " + std::to_string(bytes) +
         "\r\n" + more + "\r\n";
}

/// A server that takes files of 100 kB.
class FileServer : public Server {
 protected:
  void start(WebServerConfig config = {}) {
    config.max_file_bytes = 100'000;
    server_ =
        std::make_unique<WebServer>(config, echo, [this](std::string_view target, io::WorkFolder folder) {
          const std::filesystem::path path = folder.file(WebServer::kFileName);
          std::ifstream file(path);
          std::stringstream content;
          content << file.rdbuf();
          taken_.push_back(content.str());
          path_ = path;
          is_private_ = (std::filesystem::status(path.parent_path()).permissions() &
                         (std::filesystem::perms::group_all | std::filesystem::perms::others_all)) ==
                        std::filesystem::perms::none;
          return WebAnswer{200, "text/plain", "took " + std::string(target)};
        });
  }

  // Of the server's thread; are read when its answer has come.
  std::vector<std::string> taken_;
  std::filesystem::path path_;
  bool is_private_ = false;
};

TEST_F(FileServer, TakesAFileOfItsPage) {
  start();
  std::string content(100'000, '\0');
  for (std::size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * 7);
  EXPECT_THAT(answer_to(put("/open?name=a", content.size(), "Origin: http://localhost\r\n") + content),
              HasSubstr("took /open?name=a"));
  ASSERT_EQ(taken_.size(), 1U);
  EXPECT_EQ(taken_[0], content);
  EXPECT_TRUE(is_private_) << "nobody else can read it";
  EXPECT_FALSE(std::filesystem::exists(path_.parent_path())) << "it is removed";
  EXPECT_THAT(answer_to(put("/open", 1) + "x"), HasSubstr("took /open")) << "and then another one";
  EXPECT_THAT(answer_to(get("/b", "Connection: close\r\n")), HasSubstr("you asked for /b"));
}

TEST_F(FileServer, TakesNoFileOfAnybodyElseNorElsewhereNorTooLarge) {
  start();
  EXPECT_THAT(answer_to(put("/open", 1, "Origin: http://evil.example\r\n") + "x"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer_to("PUT /open HTTP/1.1\r\nHost: evil.example\r\nContent-Length: 1\r\n\r\nx"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer_to(put("/elsewhere", 1) + "x"), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(answer_to("POST /open HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\n\r\nx"),
              StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(answer_to("OPTIONS /open HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n"
                        "Access-Control-Request-Method: PUT\r\n\r\n"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer_to(get("/", "Content-Length: 5\r\n") + "hello"), StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(answer_to(put("/open", 100'001)), StartsWith("HTTP/1.1 413"));
  // A length that is not told in advance is limited too.
  Client chunked = client();
  chunked.send("PUT /open HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n");
  for (int i = 0; i < 3; ++i) chunked.send("c350\r\n" + std::string(50'000, 'x') + "\r\n");
  EXPECT_THAT(chunked.receive_all(), StartsWith("HTTP/1.1 413"));
  EXPECT_TRUE(taken_.empty());
}

TEST_F(FileServer, TakesOneFileAtATime) {
  start();
  Client first = client();
  first.send(put("/open", 10) + "01234");
  std::string answer;
  do {  // until the server has read the header of the first one
    answer = answer_to(put("/open", 1) + "x");
  } while (answer.starts_with("HTTP/1.1 200"));
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 503"));
  first.send("56789");
  EXPECT_THAT(first.receive_all(), HasSubstr("took /open"));
  EXPECT_EQ(taken_.back(), "0123456789");
  client().send(put("/open", 10) + "01234");  // and leaves
  do {
    answer = answer_to(put("/open", 1) + "x");
  } while (answer.starts_with("HTTP/1.1 503"));
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200"));
}

TEST_F(FileServer, TakesNoFileWhereOtherHostsReachIt) {
  start({.address = "0.0.0.0", .token = "secret"});
  EXPECT_THAT(answer_to(put("/open?token=secret", 1) + "x"), StartsWith("HTTP/1.1 403"));
  EXPECT_TRUE(taken_.empty());
}

TEST_F(Server, CutsOffWhoSendsNoWholeRequest) {
  start({.patience_s = 0.2});
  Client silent = client(), slow = client();
  slow.send("GET / HTTP/1.1\r\nHost: loc");
  EXPECT_EQ(silent.receive_all(), "");
  EXPECT_EQ(slow.receive_all(), "");
}

TEST_F(Server, AsksForTheTokenAndRemembersIt) {
  start({.token = "secret"});
  EXPECT_THAT(answer_to(get("/")), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(answer_to(upgrade()), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(answer_to(get("/?token=secret", "Connection: close\r\n")),
              HasSubstr("Set-Cookie: laneloom_view=secret; Path=/; HttpOnly; SameSite=Strict"));
  EXPECT_THAT(answer_to(get("/", "Connection: close\r\nCookie: laneloom_view=secret\r\n")),
              StartsWith("HTTP/1.1 200"));
}

TEST_F(Server, SendsFramesToAllAndTheNewestToLateComers) {
  start();
  Client early = client();
  early.send(upgrade("Origin: http://localhost\r\n"));
  EXPECT_THAT(early.receive_until("\r\n\r\n"), StartsWith("HTTP/1.1 101"));
  server_->publish("first frame");
  early.receive_until("first frame");
  server_->publish("second frame");
  early.receive_until("second frame");
  Client late = client();
  late.send(upgrade());
  const std::string heard = late.receive_until("second frame");
  EXPECT_THAT(heard, Not(HasSubstr("first frame")));
}

TEST_F(Server, ASlowViewerLosesFramesAndSlowsNobody) {
  start();
  Client slow = client(), quick = client();
  for (Client* viewer : {&slow, &quick}) {
    viewer->send(upgrade());
    viewer->receive_until("\r\n\r\n");
  }
  constexpr int kFrames = 400;
  for (int i = 0; i < kFrames; ++i) {  // 40 MB: more than any kernel keeps for who does not read
    server_->publish(std::string(100'000, '.').append("#").append(std::to_string(i)).append("#"));
    quick.receive_until("#" + std::to_string(i) + "#");
  }
  const std::string last = "#" + std::to_string(kFrames - 1) + "#";
  const std::string heard = slow.receive_until(last);
  EXPECT_LT(std::count(heard.begin(), heard.end(), '#'), kFrames);
}

/// A text as a client sends it, with an empty mask; shorter than 65536 bytes.
std::string client_text(const std::string& text) {
  const auto byte = [](std::size_t value) { return static_cast<char>(value & 0xFFU); };
  std::string bytes = "\x81";
  if (text.size() < 126)
    bytes += byte(0x80U | text.size());
  else
    bytes += {byte(0x80U | 126U), byte(text.size() >> 8U), byte(text.size())};
  return bytes + std::string(4, '\0') + text;
}

TEST_F(Server, SpeaksFoxglovesProtocolWhereItIsTold) {
  const std::string asking = upgrade("Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n");
  start();
  Client page = client();
  page.send(asking);  // which is for the page's stream, as there is no other
  EXPECT_THAT(page.receive_until("\r\n\r\n"), Not(HasSubstr("Sec-WebSocket-Protocol")));
  start({.foxglove_topics = {{"/tf", "Transform", "struct Transform {};"}}});
  server_->publish(0, 1, "first transform");
  Client program = client();
  program.send(asking);
  const std::string greeting = program.receive_until("struct Transform {};");
  EXPECT_THAT(greeting, HasSubstr("Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n"));
  EXPECT_THAT(greeting, HasSubstr("serverInfo"));
  program.send(client_text(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":1}]})"));
  program.receive_until("first transform");
  server_->publish("a frame of the page");
  server_->publish(0, 2, "second transform");
  EXPECT_THAT(program.receive_until("second transform"), Not(HasSubstr("a frame of the page")));
  program.send(client_text("no message"));
  program.receive_all();
}

TEST_F(Server, EndsViewersThatSendTooMuch) {
  start();
  Client loud = client();
  loud.send(upgrade());
  loud.receive_until("\r\n\r\n");
  loud.send(client_text(std::string(20'000, 'x')));
  loud.receive_all();
  Client other = client();
  other.send(get("/b"));
  other.receive_until("you asked for /b");
}

TEST_F(Server, LimitsViewersAndConnections) {
  start({.max_viewers = 1, .max_connections = 3});
  Client first = client();
  first.send(upgrade());
  first.receive_until("\r\n\r\n");
  EXPECT_THAT(answer_to(upgrade()), StartsWith("HTTP/1.1 503"));
  Client second = client(), third = client();
  for (Client* one : {&second, &third}) {
    one->send(get("/a"));
    one->receive_until("you asked");
  }
  EXPECT_EQ(client().receive_all(), "");
}

TEST_F(Server, ConnectionsThatSayNothingGiveWay) {
  start({.token = "secret", .max_connections = 3});
  Client silent = client(), half = client(), wrong = client();
  half.send("GET /a HTTP/1.1\r\n");
  for (const char* target : {"/a?token=secret", "/b?token=secret", "/c?token=secret"}) {
    Client known = client();
    known.send(get(target));
    EXPECT_THAT(known.receive_until("you asked"), StartsWith("HTTP/1.1 200"));
  }
  EXPECT_EQ(silent.receive_all(), "");
}

TEST_F(Server, SaysWhereItCannotListen) {
  start();
  EXPECT_THAT(thrown_by([&] { const WebServer second({.port = server_->port()}, echo); }),
              HasSubstr("cannot listen on 127.0.0.1, port "));
  EXPECT_THROW(WebServer({.address = "no address"}, echo), std::runtime_error);
}

TEST_F(Server, EndsWhileClientsAreConnected) {
  start();
  Client viewer = client(), idle = client();
  viewer.send(upgrade());
  viewer.receive_until("\r\n\r\n");
  server_.reset();
  viewer.receive_all();
  idle.receive_all();
}

}  // namespace
}  // namespace laneloom::view
