#include "dds/self_probe.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "base/random_id.hpp"

namespace laneloom::dds {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kAckNackKind = 0x06, kHeartbeatKind = 0x07, kLowestByteFirst = 0x01;
/// Of the announcements of publications and subscriptions, open and secured, without the kind.
constexpr std::array<std::array<std::uint8_t, 3>, 4> kDiscovery{
    {{0x00, 0x00, 0x03}, {0x00, 0x00, 0x04}, {0xff, 0x00, 0x03}, {0xff, 0x00, 0x04}}};
constexpr std::uint8_t kWriter = 0xc2, kReader = 0xc7;

void append(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

void append_entity(Bytes& bytes, const std::array<std::uint8_t, 3>& key, std::uint8_t kind) {
  append(bytes, {key[0], key[1], key[2], kind});
}

void append_number(Bytes& bytes, std::uint64_t number) {
  for (unsigned shift = 0; shift < 64; shift += 8)
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// A heartbeat and an acknowledgement of nobody to all endpoints of discovery. Each of them takes its lock to
/// find that it does not know the other, and the participant takes its own. Nobody can guess their sender.
Bytes make_question() {
  Bytes result{'R', 'T', 'P', 'S', 2, 3, 0, 0, 'l', 'a', 'n', 'e'};
  append_number(result, random_id());
  for (const auto& key : kDiscovery) {
    append(result, {kHeartbeatKind, kLowestByteFirst, 28, 0});
    append_entity(result, key, kReader);
    append_entity(result, key, kWriter);
    append(result,
           {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});  // none of none; the first one
    append(result, {kAckNackKind, kLowestByteFirst, 24, 0});
    append_entity(result, key, kReader);
    append_entity(result, key, kWriter);
    append(result, {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});  // nothing is missing; the first one
  }
  return result;
}

}  // namespace

SelfProbe::SelfProbe()
    : question_(make_question()), socket_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {}

SelfProbe::~SelfProbe() {
  if (socket_ >= 0) close(socket_);
}

void SelfProbe::add_port(in_addr address, std::uint16_t port) {
  const std::lock_guard lock(mutex_);
  ports_[port].address = {
      .sin_family = AF_INET, .sin_port = htons(port), .sin_addr = address, .sin_zero = {}};
}

void SelfProbe::note_taken(std::uint16_t port) {
  const std::lock_guard lock(mutex_);
  const auto found = ports_.find(port);
  if (found == ports_.end()) return;
  found->second.has_taken = true;
  found->second.unanswered = 0;
}

SelfCheck SelfProbe::ask() {
  const std::lock_guard lock(mutex_);
  SelfCheck found;
  for (auto& [number, port] : ports_) {
    const bool is_sent = send_to(port.address);
    if (!port.has_taken) continue;
    found.unanswered = std::max(found.unanswered, port.unanswered);
    if (is_sent)
      ++port.unanswered;
    else
      found.address_gone = true;
  }
  return found;
}

/// Sends a question from an address to itself. It is not sent if the host no longer has this address: another
/// host would get it.
bool SelfProbe::send_to(sockaddr_in address) {
  iovec bytes{question_.data(), question_.size()};
  const in_pktinfo from{.ipi_ifindex = 0, .ipi_spec_dst = address.sin_addr, .ipi_addr = {}};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof from)> control{};
  msghdr message{&address, sizeof address, &bytes, 1, control.data(), control.size(), 0};
  cmsghdr* const header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = IPPROTO_IP;
  header->cmsg_type = IP_PKTINFO;
  header->cmsg_len = CMSG_LEN(sizeof from);
  std::memcpy(CMSG_DATA(header), &from, sizeof from);
  return sendmsg(socket_, &message, 0) >= 0;
}

bool SelfProbe::is_question(std::span<const std::uint8_t> datagram) const {
  return std::ranges::equal(datagram, question_);
}

}  // namespace laneloom::dds
