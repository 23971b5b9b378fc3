// The only source that includes Boost.Beast, which takes half a minute to compile.
#include "view/web_server.hpp"

#include <boost/asio/post.hpp>
#include <stdexcept>
#include <thread>
#include <vector>

#include "view/web_viewer.hpp"

namespace laneloom::view {
namespace {

constexpr std::uint32_t kMaxHeaderBytes = 8192;
constexpr std::chrono::seconds kFilePatience{120};
constexpr int kSendBufferBytes = 1 << 17;  // the kernel's; a tab that was suspended sees few old frames

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

Knock knock_of(const Request& request) {
  return {.method = view_of(request.method_string()),
          .target = view_of(request.target()),
          .host = view_of(request[http::field::host]),
          .origin = view_of(request[http::field::origin]),
          .cookie = view_of(request[http::field::cookie]),
          .authorization = view_of(request[http::field::authorization])};
}

/// A file that is being put. There is one at a time.
struct Upload {
  Upload(Hub& server, http::request_parser<http::empty_body>&& header)
      : hub(server), parser(std::move(header)) {
    hub.takes_file = true;
    parser.get().body().open(folder.file(WebServer::kFileName).c_str(), beast::file_mode::write_new, failure);
  }
  Upload(const Upload&) = delete;
  Upload& operator=(const Upload&) = delete;
  ~Upload() { hub.takes_file = false; }

  Hub& hub;
  io::WorkFolder folder;
  FileParser parser;
  error_code failure;  ///< of the folder's file
};

/// A connection over which requests come, one after another.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Tcp::socket&& socket, Hub& hub) : stream_(std::move(socket)), hub_(hub), place_(hub) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(hub_.config.max_file_bytes);
    stream_.expires_after(hub_.patience());
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](error_code error, std::size_t) { self->on_read(error); });
  }

  /// Whether no request came yet that the door let in.
  bool is_unknown() const { return !known_; }
  void close() { stream_.close(); }

 private:
  void on_read(error_code error) {
    if (error == asio::error::operation_aborted) return;  // it was closed
    if (error == beast::error::timeout || error == http::error::end_of_stream) return end();
    // The rest of a malformed request, or of one with a body that is not taken, is not read.
    if (error) return refuse(status_of(error));
    const Request& request = parser_->get();
    const std::string_view protocol = foxglove_protocol(request);
    Knock knock = knock_of(request);
    knock.is_for_programs = !protocol.empty();
    knock.is_file =
        hub_.take_file && knock.method == "PUT" && Target(knock.target).path == WebServer::kFilePath;
    const unsigned status = hub_.door.judge(knock);
    if (status != 200) return refuse(status);
    known_ = true;
    if (knock.is_file) return receive();
    if (!parser_->is_done()) return refuse(413);
    if (!protocol.empty()) return upgrade(std::make_unique<FoxgloveStream>(*hub_.foxglove), protocol);
    if (Target(knock.target).path == "/live") return upgrade(std::make_unique<PageStream>(kPageChannel), {});
    answer_with([&] { return hub_.handler(view_of(request.target())); }, request.keep_alive());
  }

  static unsigned status_of(error_code error) {
    if (error == http::error::header_limit) return 431;
    return error == http::error::body_limit ? 413 : 400;
  }

  /// Writes the file that follows the header to a folder of its own, and hands it over.
  void receive() {
    if (hub_.takes_file) return refuse(503);
    try {
      upload_.emplace(hub_, std::move(*parser_));
    } catch (const std::exception&) {
      return refuse(500);
    }
    if (upload_->failure) return refuse(500);
    stream_.expires_after(kFilePatience);
    http::async_read(stream_, buffer_, upload_->parser,
                     [self = shared_from_this()](error_code error, std::size_t) { self->on_file(error); });
  }

  void on_file(error_code error) {
    const std::string target(view_of(upload_->parser.get().target()));
    const bool keep_alive = upload_->parser.get().keep_alive();
    upload_->parser.get().body().close();
    io::WorkFolder folder = std::move(upload_->folder);
    upload_.reset();
    if (error == asio::error::operation_aborted) return;  // it was closed
    if (error == beast::error::timeout || error == http::error::partial_message) return end();
    const bool of_http = error.category() == make_error_code(http::error::body_limit).category();
    if (error) return refuse(of_http ? status_of(error) : 507);  // else the disk is full
    answer_with([&] { return hub_.take_file(target, std::move(folder)); }, keep_alive);
  }

  /// The subprotocol of Foxglove that a request asks for. Empty: it asks for none.
  std::string_view foxglove_protocol(const Request& request) const {
    if (!hub_.foxglove || !websocket::is_upgrade(request)) return {};
    return foxglove_subprotocol(view_of(request[http::field::sec_websocket_protocol]));
  }

  void upgrade(std::unique_ptr<Stream> content, std::string_view protocol) {
    if (!websocket::is_upgrade(parser_->get())) return refuse(426);
    if (hub_.viewers.size() >= hub_.config.max_viewers) return refuse(503);
    const auto viewer =
        std::make_shared<Viewer>(std::move(stream_), hub_, std::move(place_), std::move(content));
    viewer->accept(parser_->get(), protocol);
  }

  void refuse(unsigned status) {
    const std::string_view reason = view_of(http::obsolete_reason(static_cast<http::status>(status)));
    answer({status, "text/plain", std::string(reason) + "\n"}, false);
  }

  /// Answers with what `make` returns. What it throws ends neither the server nor other connections.
  template <class Make>
  void answer_with(const Make& make, bool keep_alive) {
    WebAnswer made;
    try {
      made = make();
    } catch (const std::exception&) {
      return refuse(500);
    }
    answer(std::move(made), keep_alive);
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
  bool known_ = false;
  beast::flat_buffer buffer_{2UL * kMaxHeaderBytes};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<Upload> upload_;
  http::response<http::string_body> response_;
};

}  // namespace

class WebServer::Impl {
 public:
  Impl(const WebServerConfig& config, Handler handler, FileTaker take_file)
      : hub_(config, std::move(handler), std::move(take_file)) {
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

  void publish(Publication publication) {
    asio::post(context_, [this, publication = std::move(publication)] { hub_.publish(publication); });
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
      if (make_room()) {
        const auto connection = std::make_shared<Connection>(std::move(socket), hub_);
        connection->read();
        newcomers_.push_back(connection);
      }
      accept();
    });
  }

  /// Whether there is room for one more connection. Where all places are taken, the oldest connection goes
  /// that has not said anything that the door lets in: whoever opens many and says nothing does not shut out
  /// the others.
  bool make_room() {
    std::erase_if(newcomers_, [](const auto& newcomer) { return newcomer.expired(); });
    if (hub_.connections < hub_.config.max_connections) return true;
    for (auto newcomer = newcomers_.begin(); newcomer != newcomers_.end(); ++newcomer) {
      const auto connection = newcomer->lock();
      if (!connection || !connection->is_unknown()) continue;
      connection->close();
      newcomers_.erase(newcomer);
      return true;
    }
    return false;
  }

  /// Accepts again after a pause: the process may be out of file descriptors for a moment.
  void retry() {
    pause_.expires_after(std::chrono::milliseconds(100));
    pause_.async_wait([this](error_code) { accept(); });
  }

  Hub hub_;  // outlives the connections, which end with the context
  asio::io_context context_{1};
  Tcp::acceptor acceptor_{context_};
  asio::steady_timer pause_{context_};
  std::vector<std::weak_ptr<Connection>> newcomers_;  ///< that are no viewers yet, the oldest first
  std::thread thread_;
};

WebServer::WebServer(const WebServerConfig& config, Handler handler, FileTaker take_file)
    : impl_(std::make_unique<Impl>(config, std::move(handler), std::move(take_file))) {}

WebServer::~WebServer() = default;

std::uint16_t WebServer::port() const { return impl_->port(); }

void WebServer::publish(std::string frame) {
  impl_->publish({.channel = kPageChannel, .body = std::make_shared<const std::string>(std::move(frame))});
}

void WebServer::publish(std::size_t topic, std::int64_t log_time_ns, std::string message) {
  impl_->publish({.channel = kFirstTopicChannel + topic,
                  .log_time_ns = log_time_ns,
                  .body = std::make_shared<const std::string>(std::move(message))});
}

}  // namespace laneloom::view
