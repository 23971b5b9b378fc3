#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "recording/recording.hpp"
#include "view/stream.hpp"

namespace laneloom::view {

/// The newest of Foxglove's subprotocols among those offered (Sec-WebSocket-Protocol). Empty: none is
/// offered. The messages of a server are the same in all of them.
std::string_view foxglove_subprotocol(std::string_view offered);

/// The first messages to clients of Foxglove's WebSocket protocol. Immutable.
struct FoxgloveGreeting {
  /// Clients that come back to another `session` forget all that they showed. The channels of the topics,
  /// whose messages are CDR, begin at `first_channel`.
  FoxgloveGreeting(const std::vector<recording::ExtraTopic>& topics, std::size_t first_channel,
                   const std::string& session);

  std::shared_ptr<const std::string> server_info, advertise;
  std::size_t first_channel, end_channel;
};

/// A client of Foxglove's WebSocket protocol, such as Foxglove and Lichtblick: it subscribes to channels, and
/// can do nothing else.
class FoxgloveStream final : public Stream {
 public:
  /// `greeting` outlives this.
  explicit FoxgloveStream(const FoxgloveGreeting& greeting) : greeting_(greeting) {}
  void open(const NewestPublications& newest, Outbox& outbox) override;
  bool receive(std::string_view text, const NewestPublications& newest, Outbox& outbox) override;
  void publish(const Publication& publication, Outbox& outbox) override;

 private:
  void subscribe(std::uint32_t subscription, std::uint64_t channel, const NewestPublications& newest,
                 Outbox& outbox);

  const FoxgloveGreeting& greeting_;
  std::map<std::uint32_t, std::size_t> channels_;  ///< by the client's numbers of its subscriptions
};

}  // namespace laneloom::view
