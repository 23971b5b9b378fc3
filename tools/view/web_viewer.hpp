#pragma once

// A part of web_server.cpp. No other source may include it, because Boost.Beast takes half a minute to
// compile.

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "view/door.hpp"
#include "view/foxglove_stream.hpp"
#include "view/stream.hpp"
#include "view/web_server.hpp"

namespace laneloom::view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Tcp = asio::ip::tcp;
using Request = http::request<http::empty_body>;

inline constexpr std::size_t kPageChannel = 0, kFirstTopicChannel = 1;

class Viewer;

/// The request by which a page puts a file.
using FileParser = http::request_parser<http::file_body>;

/// The state that all connections share. Only the server's thread uses it.
struct Hub {
  Hub(const WebServerConfig& server, WebServer::Handler answer, WebServer::FileTaker file_taker)
      : config(server),
        door(server.address, server.token, server.foxglove_origins),
        handler(std::move(answer)),
        take_file(std::move(file_taker)),
        newest(kFirstTopicChannel + server.foxglove_topics.size()) {
    if (!server.foxglove_topics.empty())
      foxglove.emplace(server.foxglove_topics, kFirstTopicChannel, random_token());
  }

  std::chrono::milliseconds patience() const {
    return std::chrono::milliseconds(static_cast<std::int64_t>(config.patience_s * 1e3));
  }
  void publish(const Publication& publication);

  WebServerConfig config;
  Door door;
  WebServer::Handler handler;
  WebServer::FileTaker take_file;
  bool takes_file = false;  ///< now
  std::optional<FoxgloveGreeting> foxglove;
  std::set<Viewer*> viewers;
  std::size_t connections = 0;
  NewestPublications newest;
};

/// Counts a connection for as long as it lives.
class Place {
 public:
  explicit Place(Hub& hub) : hub_(&hub) { ++hub_->connections; }
  Place(Place&& other) noexcept : hub_(std::exchange(other.hub_, nullptr)) {}
  Place& operator=(Place&&) = delete;
  ~Place() {
    if (hub_ != nullptr) --hub_->connections;
  }

 private:
  Hub* hub_;
};

/// One client that is sent a stream.
class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  Viewer(beast::tcp_stream&& socket, Hub& hub, Place&& place, std::unique_ptr<Stream> stream)
      : socket_(std::move(socket)), hub_(hub), place_(std::move(place)), stream_(std::move(stream)) {
    hub_.viewers.insert(this);
  }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  ~Viewer() { hub_.viewers.erase(this); }

  /// `protocol` is the subprotocol to answer with; empty: none.
  void accept(const Request& request, std::string_view protocol) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has times of its own
    socket_.set_option(
        {.handshake_timeout = hub_.patience(), .idle_timeout = kSilence, .keep_alive_pings = true});
    socket_.set_option(websocket::stream_base::decorator([protocol](websocket::response_type& response) {
      if (!protocol.empty())
        response.set(http::field::sec_websocket_protocol,
                     beast::string_view(protocol.data(), protocol.size()));
    }));
    socket_.read_message_max(kMaxMessageBytes);
    socket_.auto_fragment(false);  // else each 4 KB of a message are a call of the kernel
    socket_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) return;
      self->listen();
      self->accepted_ = true;
      self->stream_->open(self->hub_.newest, self->outbox_);
      self->send();
    });
  }

  void offer(const Publication& publication) {
    if (!accepted_) return;
    stream_->publish(publication, outbox_);
    send();
  }

 private:
  void send() {
    if (sending_) return;
    sending_ = outbox_.next();
    if (!sending_) return;
    socket_.binary(sending_->binary);
    const std::array<asio::const_buffer, 2> parts{asio::buffer(sending_->header),
                                                  asio::buffer(*sending_->body)};
    socket_.async_write(parts, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return;  // nothing more is sent
      self->sending_.reset();
      self->send();
    });
  }

  /// Reads on, for subscriptions, pongs and the end.
  void listen() {
    socket_.async_read(inbox_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error || !self->take()) return self->leave();
      self->listen();
    });
  }

  /// Takes a message of the client. A message that is no text is dropped. Returns false if the client must be
  /// disconnected.
  bool take() {
    const auto bytes = inbox_.cdata();
    const std::string_view text(static_cast<const char*>(bytes.data()), bytes.size());
    const bool good = !socket_.got_text() || stream_->receive(text, hub_.newest, outbox_);
    inbox_.clear();
    send();
    return good;
  }

  /// Closes the socket. This ends a write that may wait for a viewer which reads nothing.
  void leave() {
    error_code ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

  static constexpr std::size_t kMaxMessageBytes = 16384;  // of a message that a client sends
  /// A client that answers no ping for this long is gone.
  static constexpr std::chrono::seconds kSilence{60};

  websocket::stream<beast::tcp_stream> socket_;
  Hub& hub_;
  Place place_;
  std::unique_ptr<Stream> stream_;
  beast::flat_buffer inbox_{kMaxMessageBytes};
  bool accepted_ = false;
  Outbox outbox_;
  std::optional<WebMessage> sending_;
};

inline void Hub::publish(const Publication& publication) {
  newest[publication.channel] = publication;
  for (Viewer* viewer : viewers) viewer->offer(publication);
}

}  // namespace laneloom::view
