#include "view/web_server.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "view/file_desk.hpp"
#include "view/site.hpp"

namespace {

using namespace laneloom;

constexpr std::size_t kMaxFileBytes = 100;
constexpr std::string_view kEndOfHeaders = "\r\n\r\n";

/// A viewer of a recording and of live frames at once, so that everything there is can be asked for.
class Viewer {
 public:
  Viewer() {
    frames_.add(0, R"({"number":0})", R"({"elements":[]})");
    frames_.finish();
    server_.publish(R"({"number":0})");
    server_.publish(0, 1, "transform");
  }
  std::uint16_t port() const { return server_.port(); }

 private:
  view::FrameStore frames_;
  view::Site site_{{.title = "fuzz"}, frames_};
  view::FileDesk desk_{site_,
                       [](const std::filesystem::path&, view::FrameStore& store, const std::stop_token&) {
                         store.finish("it is not read");
                       },
                       kMaxFileBytes};
  view::WebServer server_{{.patience_s = 0.2,
                           .max_file_bytes = kMaxFileBytes,
                           .foxglove_topics = {{"/tf", "Transform", "struct Transform {};"}}},
                          [this](std::string_view target) { return desk_.answer(target); },
                          [this](std::string_view target, io::WorkFolder folder) {
                            return desk_.open(target, std::move(folder));
                          }};
};

int connect_to(std::uint16_t port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in server{};
  server.sin_family = AF_INET;
  server.sin_port = htons(port);
  server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  while (connect(socket, reinterpret_cast<const sockaddr*>(&server), sizeof server) != 0) usleep(1000);
  return socket;
}

void send_all(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return;  // the server has had enough
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

/// False: the server has ended the connection.
bool receive(int socket, std::string& to) {
  std::array<char, 4096> part{};
  const ssize_t size = recv(socket, part.data(), part.size(), 0);
  if (size > 0) to.append(part.data(), static_cast<std::size_t>(size));
  return size > 0;
}

}  // namespace

/// The input is all that one connection sends. The bytes after a request are sent once it is answered, as
/// messages of a WebSocket are. The server has to end each connection that its client ended.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Viewer viewer;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = bytes.find(kEndOfHeaders);
  const std::size_t first = end == std::string_view::npos ? size : end + kEndOfHeaders.size();
  const int socket = connect_to(viewer.port());
  std::string answer;
  send_all(socket, bytes.substr(0, first));
  if (first < size) {
    while (answer.find(kEndOfHeaders) == std::string::npos && receive(socket, answer)) {
    }
    send_all(socket, bytes.substr(first));
  }
  shutdown(socket, SHUT_WR);
  while (receive(socket, answer)) {
  }
  close(socket);
  return 0;
}
