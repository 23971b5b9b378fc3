#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/work_folder.hpp"
#include "recording/recording.hpp"

namespace laneloom::view {

/// Address, limits and offered protocols of a web server.
struct WebServerConfig {
  std::string address = "127.0.0.1";  ///< as a number, not a name
  std::uint16_t port = 0;             ///< 0: a free one
  std::string token;                  ///< must be brought by every request; empty: there is none
  std::size_t max_viewers = 64;       ///< WebSockets; a further one is answered with 503
  std::size_t max_connections = 256;  ///< HTTP and WebSockets; a further one replaces one that is silent
  double patience_s = 15.0;           ///< for a whole request, and for a client to take its answer
  std::size_t max_file_bytes = 0;     ///< of a file that is put; 0: no file is taken
  std::vector<recording::ExtraTopic>
      foxglove_topics;  ///< for clients of Foxglove's protocol; empty: it is not offered
  std::vector<std::string> foxglove_origins;  ///< origins of other pages that may be such clients
};

/// The answer to a request.
struct WebAnswer {
  unsigned status = 200;  ///< of HTTP
  std::string type = "application/json";
  std::string body;
};

/// Serves a page by HTTP, a stream of frames by WebSocket (`/live`), and topics by Foxglove's protocol (a
/// WebSocket of any path that asks for it), in a thread of its own.
///
/// Only GET is answered, only to its own pages (view/door.hpp), and with a policy (CSP) that lets a page load
/// nothing from elsewhere. A page may PUT a file to kFilePath, one at a time, if no other host reaches the
/// server. Of the messages that clients send over their WebSockets, only Foxglove's
/// subscriptions are read. Each client has a slot for one frame, or one for each topic: if a client is slow,
/// a newer message replaces the one that waits.
class WebServer {
 public:
  /// Answers a GET of `target`. Called by the server's thread; must not throw, nor take long.
  using Handler = std::function<WebAnswer(std::string_view target)>;

  /// Takes a file that a page has put, `kFileName` in `folder`. Likewise.
  using FileTaker = std::function<WebAnswer(std::string_view target, io::WorkFolder folder)>;

  static constexpr const char* kFilePath = "/open";
  static constexpr const char* kFileName = "file";

  /// Throws std::runtime_error if it can not listen on the address. `take_file` may be empty if
  /// config.max_file_bytes is 0.
  WebServer(const WebServerConfig& config, Handler handler, FileTaker take_file = {});
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  /// Ends all connections.
  ~WebServer();

  std::uint16_t port() const;
  /// Sends the frame to all viewers, and to viewers that come later until there is a newer frame.
  /// Thread-safe.
  void publish(std::string frame);
  /// Sends a message of `foxglove_topics[topic]`, as CDR, to its subscribers, and to later ones likewise.
  /// Thread-safe.
  void publish(std::size_t topic, std::int64_t log_time_ns, std::string message);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::view
