// The one source that knows Boost.Beast, which takes half a minute to compile.
#include "view/web_server.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include "view/door.hpp"

namespace laneloom {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Tcp = asio::ip::tcp;
using Request = http::request<http::empty_body>;
using Frame = std::shared_ptr<const std::string>;

constexpr std::uint32_t kMaxHeaderBytes = 8192;
constexpr std::size_t kMaxMessageBytes = 1024;  // of what a viewer sends
constexpr int kSendBufferBytes = 1 << 17;       // of the kernel: a tab that was suspended sees few old frames
constexpr std::chrono::seconds kSilence{60};    // after which a viewer that answers no ping is gone

class Viewer;

/// What all connections share. Only the server's thread has to do with it.
struct Hub {
  WebServerConfig config;
  Door door;
  WebServer::Handler handler;
  std::set<Viewer*> viewers{};
  std::size_t connections = 0;
  Frame newest{};

  std::chrono::milliseconds patience() const {
    return std::chrono::milliseconds(static_cast<std::int64_t>(config.patience_s * 1e3));
  }
};

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

Knock knock_of(const Request& request) {
  return {view_of(request.method_string()),      view_of(request.target()),
          view_of(request[http::field::host]),   view_of(request[http::field::origin]),
          view_of(request[http::field::cookie]), view_of(request[http::field::authorization])};
}

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

/// One tab that is sent frames.
class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  Viewer(beast::tcp_stream&& stream, Hub& hub, Place&& place)
      : socket_(std::move(stream)), hub_(hub), place_(std::move(place)) {
    hub_.viewers.insert(this);
  }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  ~Viewer() { hub_.viewers.erase(this); }

  void accept(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has times of its own
    socket_.set_option(
        {.handshake_timeout = hub_.patience(), .idle_timeout = kSilence, .keep_alive_pings = true});
    socket_.read_message_max(kMaxMessageBytes);
    socket_.text(true);
    socket_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) return;
      self->listen();
      self->accepted_ = true;
      if (self->hub_.newest) self->offer(self->hub_.newest);
    });
  }

  void offer(const Frame& frame) {
    waiting_ = frame;
    if (accepted_ && !sending_) send();
  }

 private:
  void send() {
    sending_ = std::exchange(waiting_, nullptr);
    socket_.async_write(asio::buffer(*sending_), [self = shared_from_this()](error_code error, std::size_t) {
      self->sending_ = nullptr;
      if (!error && self->waiting_) self->send();
    });
  }

  /// For pongs and the end; what else comes is dropped.
  void listen() {
    socket_.async_read(inbox_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return self->leave();
      self->inbox_.clear();
      self->listen();
    });
  }

  /// Ends a write that may wait for a viewer who takes nothing.
  void leave() {
    error_code ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

  websocket::stream<beast::tcp_stream> socket_;
  Hub& hub_;
  Place place_;
  beast::flat_buffer inbox_{kMaxMessageBytes};
  bool accepted_ = false;
  Frame sending_, waiting_;
};

/// One connection over which requests come, one after another.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Tcp::socket&& socket, Hub& hub) : stream_(std::move(socket)), hub_(hub), place_(hub) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(0);
    stream_.expires_after(hub_.patience());
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t) { self->on_read(error); });
  }

 private:
  void on_read(error_code error) {
    if (error == beast::error::timeout || error == http::error::end_of_stream) return end();
    // Of what is no request, or one with a body, the rest is not read.
    if (error)
      return refuse(error == http::error::header_limit ? 431 : error == http::error::body_limit ? 413 : 400);
    const Request& request = parser_->get();
    const unsigned status = hub_.door.judge(knock_of(request));
    if (status != 200) return refuse(status);
    if (Target(view_of(request.target())).path == "/live") return upgrade();
    answer(hub_.handler(view_of(request.target())), request.keep_alive());
  }

  void upgrade() {
    if (!websocket::is_upgrade(parser_->get())) return refuse(426);
    if (hub_.viewers.size() >= hub_.config.max_viewers) return refuse(503);
    const auto viewer = std::make_shared<Viewer>(std::move(stream_), hub_, std::move(place_));
    viewer->accept(parser_->get());
  }

  void refuse(unsigned status) {
    const std::string_view reason = view_of(http::obsolete_reason(static_cast<http::status>(status)));
    answer({status, "text/plain", std::string(reason) + "\n"}, false);
  }

  void answer(WebAnswer&& answer, bool keep_alive) {
    response_ = {};
    response_.version(11);
    response_.result(answer.status);
    response_.keep_alive(keep_alive);
    response_.body() = std::move(answer.body);
    set_headers(answer);
    response_.prepare_payload();
    stream_.expires_after(hub_.patience());
    http::async_write(stream_, response_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error || !self->response_.keep_alive()) return self->end();
      self->read();
    });
  }

  void set_headers(const WebAnswer& answer) {
    response_.set(http::field::content_type, answer.type);
    response_.set(http::field::cache_control, "no-store");
    response_.set(
        "Content-Security-Policy",
        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' "
        "blob: data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set("Referrer-Policy", "no-referrer");
    if (answer.status == 405) response_.set(http::field::allow, "GET");
    if (answer.status == 200 && !hub_.door.token().empty())  // so that the page's own requests bring it
      response_.set(http::field::set_cookie, std::string(Door::cookie_name()) + "=" + hub_.door.token() +
                                                 "; Path=/; HttpOnly; SameSite=Strict");
  }

  void end() {
    error_code ignored;
    stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

  beast::tcp_stream stream_;
  Hub& hub_;
  Place place_;
  beast::flat_buffer buffer_{2UL * kMaxHeaderBytes};
  std::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::string_body> response_;
};

}  // namespace

class WebServer::Impl {
 public:
  Impl(const WebServerConfig& config, Handler handler)
      : hub_{.config = config, .door = Door(config.address, config.token), .handler = std::move(handler)} {
    open();
    accept();
    thread_ = std::thread([this] { context_.run(); });
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    context_.stop();
    thread_.join();
  }

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  void publish(Frame frame) {
    asio::post(context_, [this, frame = std::move(frame)] {
      hub_.newest = frame;
      for (Viewer* viewer : hub_.viewers) viewer->offer(frame);
    });
  }

 private:
  void open() {
    try {
      const Tcp::endpoint here(asio::ip::make_address(hub_.config.address), hub_.config.port);
      acceptor_.open(here.protocol());
      acceptor_.set_option(Tcp::acceptor::reuse_address(true));
      acceptor_.set_option(asio::socket_base::send_buffer_size(kSendBufferBytes));
      acceptor_.bind(here);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw std::runtime_error("cannot listen on " + hub_.config.address + ", port " +
                               std::to_string(hub_.config.port) + ": " + error.code().message());
    }
  }

  void accept() {
    acceptor_.async_accept([this](error_code error, Tcp::socket socket) {
      if (error) return retry();
      error_code ignored;
      socket.set_option(Tcp::no_delay(true), ignored);  // else a frame waits 40 ms for an acknowledgement
      if (hub_.connections < hub_.config.max_connections)
        std::make_shared<Connection>(std::move(socket), hub_)->read();
      accept();
    });
  }

  /// The process may be out of file descriptors for a moment.
  void retry() {
    pause_.expires_after(std::chrono::milliseconds(100));
    pause_.async_wait([this](error_code) { accept(); });
  }

  Hub hub_;  // outlives the connections, which end with the context
  asio::io_context context_{1};
  Tcp::acceptor acceptor_{context_};
  asio::steady_timer pause_{context_};
  std::thread thread_;
};

WebServer::WebServer(const WebServerConfig& config, Handler handler)
    : impl_(std::make_unique<Impl>(config, std::move(handler))) {}

WebServer::~WebServer() = default;

std::uint16_t WebServer::port() const { return impl_->port(); }

void WebServer::publish(std::string frame) {
  impl_->publish(std::make_shared<const std::string>(std::move(frame)));
}

}  // namespace laneloom
