#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What clients are sent over WebSockets, apart from the sockets.
namespace laneloom {

/// Something new for all who listen to its channel.
struct Publication {
  std::size_t channel = 0;
  std::int64_t log_time_ns = 0;  ///< system clock
  std::shared_ptr<const std::string> body;
};

/// The newest publication of each channel, by its number; without a body where there was none yet.
using NewestPublications = std::vector<Publication>;

/// A message to one client.
struct WebMessage {
  bool binary = false;
  std::string header;                       ///< of this client alone, before the body
  std::shared_ptr<const std::string> body;  ///< not null
};

/// What waits to be sent to one client: a message a slot. A newer message of a slot replaces the one that
/// waits, so that a slow client loses messages and takes no more memory. Not thread-safe.
class Outbox {
 public:
  void put(std::uint64_t slot, WebMessage message);
  /// In the order in which the slots were filled.
  std::optional<WebMessage> next();

 private:
  std::vector<std::pair<std::uint64_t, WebMessage>> waiting_;
};

/// What one client is sent. Not thread-safe.
class Stream {
 public:
  virtual ~Stream() = default;
  /// The client has come.
  virtual void open(const NewestPublications& newest, Outbox& outbox) = 0;
  /// The client sent a text. False: the text breaks the protocol, and the client has to go.
  virtual bool receive(std::string_view text, const NewestPublications& newest, Outbox& outbox) = 0;
  virtual void publish(const Publication& publication, Outbox& outbox) = 0;
};

/// Every publication of one channel, as text. What the client sends is not looked at.
class PageStream final : public Stream {
 public:
  explicit PageStream(std::size_t channel) : channel_(channel) {}
  void open(const NewestPublications& newest, Outbox& outbox) override;
  bool receive(std::string_view text, const NewestPublications& newest, Outbox& outbox) override;
  void publish(const Publication& publication, Outbox& outbox) override;

 private:
  std::size_t channel_;
};

}  // namespace laneloom
