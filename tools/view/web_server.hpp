#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace laneloom {

struct WebServerConfig {
  std::string address = "127.0.0.1";  ///< a number, no name
  std::uint16_t port = 0;             ///< 0: one that is free
  std::string token;                  ///< that every request has to bring; empty: none
  std::size_t max_viewers = 64;       ///< WebSockets; one more is answered with 503
  std::size_t max_connections = 256;  ///< of both kinds; one more is closed
  double patience_s = 15.0;           ///< for a whole request, and for a client to take its answer
};

/// The answer to a GET.
struct WebAnswer {
  unsigned status = 200;  ///< of HTTP
  std::string type = "application/json";
  std::string body;
};

/// Serves a page by HTTP and a stream of frames by WebSocket (`/live`), in a thread of its own.
///
/// Only GET is answered, only to its own pages (view/door.hpp), and with a policy (CSP) that lets a page load
/// nothing from elsewhere. Nothing that a client sends over its WebSocket is looked at. Each viewer has a
/// slot for one frame: where a viewer is slow, a newer frame takes the place of the one that waits.
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

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom
