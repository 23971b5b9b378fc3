#include "view/foxglove_stream.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "io/json_text.hpp"

namespace laneloom::view {
namespace {

using nlohmann::json;

/// The subprotocols, the preferred one first. Foxglove's own programs take only that one.
constexpr std::array<std::string_view, 2> kSubprotocols{"foxglove.sdk.v1", "foxglove.websocket.v1"};
constexpr std::size_t kMaxSubscriptions = 64;

// Slots of an outbox. The slot of a subscription is the subscription's number.
constexpr std::uint64_t kServerInfoSlot = 1ULL << 32U, kAdvertiseSlot = kServerInfoSlot + 1,
                        kStatusSlot = kServerInfoSlot + 2;

std::shared_ptr<const std::string> shared(const json& message) {
  return std::make_shared<const std::string>(io::json_text(message));
}

bool offers(std::string_view list, std::string_view name) {
  while (!list.empty()) {
    std::string_view item = list.substr(0, list.find(','));
    list.remove_prefix(std::min(list.size(), item.size() + 1));
    while (item.starts_with(' ')) item.remove_prefix(1);
    while (item.ends_with(' ')) item.remove_suffix(1);
    if (item == name) return true;
  }
  return false;
}

template <class Number>
void append_little_endian(Number number, std::string& to) {
  for (std::size_t byte = 0; byte < sizeof number; ++byte)
    to += static_cast<char>((number >> (8U * byte)) & 0xFFU);
}

/// The header of a message with data: its kind, the subscription, and the log time.
std::string header_of(std::uint32_t subscription, std::int64_t log_time_ns) {
  constexpr char kMessageData = 1;
  std::string header(1, kMessageData);
  append_little_endian(subscription, header);
  append_little_endian(static_cast<std::uint64_t>(log_time_ns), header);
  return header;
}

void complain(const std::string& text, Outbox& outbox) {
  constexpr int kError = 2;
  outbox.put(kStatusSlot,
             {.header = {}, .body = shared({{"op", "status"}, {"level", kError}, {"message", text}})});
}

/// An unsigned number of 32 bits in `object`. None: it has no such number.
std::optional<std::uint32_t> number_in(const json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end() || !found->is_number_unsigned()) return std::nullopt;
  const auto number = found->get<std::uint64_t>();
  if (number > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

const json& list_in(const json& object, const char* key) {
  static const json kNone = json::array();
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : kNone;
}

}  // namespace

std::string_view foxglove_subprotocol(std::string_view offered) {
  for (const std::string_view name : kSubprotocols)
    if (offers(offered, name)) return name;
  return {};
}

FoxgloveGreeting::FoxgloveGreeting(const std::vector<recording::ExtraTopic>& topics, std::size_t first,
                                   const std::string& session)
    : first_channel(first), end_channel(first + topics.size()) {
  json channels = json::array();
  for (std::size_t i = 0; i < topics.size(); ++i)
    channels.push_back({{"id", first + i},
                        {"topic", topics[i].name},
                        {"encoding", "cdr"},
                        {"schemaName", topics[i].type},
                        {"schema", topics[i].idl},
                        {"schemaEncoding", "omgidl"}});
  server_info = shared(
      {{"op", "serverInfo"}, {"name", "laneloom"}, {"capabilities", json::array()}, {"sessionId", session}});
  advertise = shared({{"op", "advertise"}, {"channels", std::move(channels)}});
}

void FoxgloveStream::open(const NewestPublications&, Outbox& outbox) {
  outbox.put(kServerInfoSlot, {.header = {}, .body = greeting_.server_info});
  outbox.put(kAdvertiseSlot, {.header = {}, .body = greeting_.advertise});
}

/// Operations of other servers that are not offered here are passed over.
bool FoxgloveStream::receive(std::string_view text, const NewestPublications& newest, Outbox& outbox) {
  const json message = json::parse(text, nullptr, false);
  if (!message.is_object() || !message.contains("op")) return false;
  if (message["op"] == "subscribe") {
    for (const json& wanted : list_in(message, "subscriptions")) {
      const auto subscription = number_in(wanted, "id"), channel = number_in(wanted, "channelId");
      if (!subscription || !channel) return false;
      subscribe(*subscription, *channel, newest, outbox);
    }
  } else if (message["op"] == "unsubscribe") {
    for (const json& subscription : list_in(message, "subscriptionIds"))
      if (subscription.is_number_unsigned())
        std::erase_if(channels_, [&](const auto& entry) { return entry.first == subscription; });
  }
  return true;
}

void FoxgloveStream::subscribe(std::uint32_t subscription, std::uint64_t channel,
                               const NewestPublications& newest, Outbox& outbox) {
  if (channel < greeting_.first_channel || channel >= greeting_.end_channel)
    return complain("there is no channel " + std::to_string(channel), outbox);
  if (channels_.size() >= kMaxSubscriptions && !channels_.contains(subscription))
    return complain("too many subscriptions", outbox);
  channels_[subscription] = channel;
  if (newest[channel].body) publish(newest[channel], outbox);
}

void FoxgloveStream::publish(const Publication& publication, Outbox& outbox) {
  for (const auto& [subscription, channel] : channels_)
    if (channel == publication.channel)
      outbox.put(subscription, {.binary = true,
                                .header = header_of(subscription, publication.log_time_ns),
                                .body = publication.body});
}

}  // namespace laneloom::view
