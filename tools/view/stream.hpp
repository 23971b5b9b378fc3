#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The messages to clients over WebSockets, without the sockets.
namespace laneloom::view {

/// A new message for all clients of its channel.
struct Publication {
  std::size_t channel = 0;
  std::int64_t log_time_ns = 0;  ///< system clock
  std::shared_ptr<const std::string> body;
};

/// The newest publication of each channel, by its number. Without a body if there was none yet.
using NewestPublications = std::vector<Publication>;

/// A message to one client.
struct WebMessage {
  bool binary = false;
  std::string header;                       ///< comes before the body; for this client alone
  std::shared_ptr<const std::string> body;  ///< not null
};

/// The messages that wait to be sent to one client, one per slot. A newer message of a slot replaces the one
/// that waits, so that a slow client loses messages and takes no more memory. Not thread-safe.
class Outbox {
 public:
  void put(std::uint64_t slot, WebMessage message);
  /// Takes the next message, in the order in which the slots were filled. None: no message waits.
  std::optional<WebMessage> next();

 private:
  std::vector<std::pair<std::uint64_t, WebMessage>> waiting_;
};

/// Decides which messages one client is sent. Not thread-safe.
class Stream {
 public:
  virtual ~Stream() = default;
  /// Is called when the client has come.
  virtual void open(const NewestPublications& newest, Outbox& outbox) = 0;
  /// Is called when the client sent a text. Returns false if the text breaks the protocol, so that the client
  /// must be disconnected.
  virtual bool receive(std::string_view text, const NewestPublications& newest, Outbox& outbox) = 0;
  virtual void publish(const Publication& publication, Outbox& outbox) = 0;
};

/// Sends every publication of one channel, as text. Messages of the client are ignored.
class PageStream final : public Stream {
 public:
  explicit PageStream(std::size_t channel) : channel_(channel) {}
  void open(const NewestPublications& newest, Outbox& outbox) override;
  bool receive(std::string_view text, const NewestPublications& newest, Outbox& outbox) override;
  void publish(const Publication& publication, Outbox& outbox) override;

 private:
  std::size_t channel_;
};

}  // namespace laneloom::view
