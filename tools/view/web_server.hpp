#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "recording/recording.hpp"

namespace laneloom {

struct WebServerConfig {
  std::string address = "127.0.0.1";          ///< a number, no name
  std::uint16_t port = 0;                     ///< 0: one that is free
  std::string token;                          ///< that every request has to bring; empty: none
  std::size_t max_viewers = 64;               ///< WebSockets; one more is answered with 503
  std::size_t max_connections = 256;          ///< of both kinds; one more is closed
  double patience_s = 15.0;                   ///< for a whole request, and for a client to take its answer
  std::vector<ExtraTopic> foxglove_topics;    ///< for clients of Foxglove's protocol; none: it is not spoken
  std::vector<std::string> foxglove_origins;  ///< pages of other origins that may be such clients
};

/// The answer to a GET.
struct WebAnswer {
  unsigned status = 200;  ///< of HTTP
  std::string type = "application/json";
  std::string body;
};

/// Serves a page by HTTP, a stream of frames by WebSocket (`/live`), and topics by Foxglove's protocol (a
/// WebSocket of any path that asks for it), in a thread of its own.
///
/// Only GET is answered, only to its own pages (view/door.hpp), and with a policy (CSP) that lets a page load
/// nothing from elsewhere. Of what clients send over their WebSockets, only Foxglove's subscriptions are
/// looked at. Each client has a slot for one frame, or one of each topic: where a client is slow, a newer
/// message takes the place of the one that waits.
class WebServer {
 public:
  /// Answers a GET of `target`. Called by the server's thread; must not throw, nor take long.
  using Handler = std::function<WebAnswer(std::string_view target)>;

  /// Throws std::runtime_error where the address cannot be listened on.
  WebServer(const WebServerConfig& config, Handler handler);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  /// Ends all connections.
  ~WebServer();

  std::uint16_t port() const;
  /// Gives the frame to all viewers, and to those who come later until there is a newer one. Thread-safe.
  void publish(std::string frame);
  /// Gives the message of `foxglove_topics[topic]`, as CDR, to its subscribers, likewise.
  void publish(std::size_t topic, std::int64_t log_time_ns, std::string message);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom
