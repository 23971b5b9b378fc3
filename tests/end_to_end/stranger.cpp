// stranger DOMAIN COUNT SEED CAPTURE...: sends COUNT damaged datagrams (0: without end) to all ports of a
// domain. They are made of those in the CAPTUREs (tests/dds/captures), and most are in the names of
// participants that are heard in the domain.
#include "stranger.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "dds/captured_datagrams.hpp"
#include "eavesdropper.hpp"
#include "mutation.hpp"

namespace laneloom {
namespace {

constexpr std::uint64_t kAtOnce = 100;
constexpr std::chrono::milliseconds kPause{5};
constexpr std::ptrdiff_t kPrefixAt = 8;
constexpr std::uint8_t kInfoDestination = 0x0e;

class Attack {
 public:
  Attack(int domain, std::uint64_t seed, std::vector<dds::Packet> captured)
      : stranger_(domain), eavesdropper_(domain), mutation_(std::move(captured), seed) {}

  void send_some() {
    heard_ = eavesdropper_.participants();
    ports_ = stranger_.ports();
    for (std::uint64_t i = 0; i < kAtOnce; ++i) send(next());
  }

 private:
  dds::Packet next() {
    const auto& originals = mutation_.originals();
    dds::Packet packet = originals[mutation_.below(originals.size())];
    if (!heard_.empty() && mutation_.below(8) > 0) take_names(packet);
    mutation_.damage(packet);
    return packet;
  }

  /// Speaks in the name of one who was heard, to another one.
  void take_names(dds::Packet& packet) {
    put(packet, kPrefixAt);
    constexpr std::ptrdiff_t kHeaderBytes = 20, kSubmessageHeaderBytes = 4;
    if (packet.size() > kHeaderBytes && packet[kHeaderBytes] == kInfoDestination)
      put(packet, kHeaderBytes + kSubmessageHeaderBytes);
  }
  void put(dds::Packet& packet, std::ptrdiff_t at) {
    std::ranges::copy(heard_[mutation_.below(heard_.size())], packet.begin() + at);
  }

  void send(const dds::Packet& packet) {
    const std::size_t to = mutation_.below(1 + ports_.size());
    if (to == ports_.size()) return stranger_.send_to_all(packet);
    stranger_.send_to(ports_[to], packet);
  }

  Stranger stranger_;
  Eavesdropper eavesdropper_;
  Mutation mutation_;
  std::vector<dds::Prefix> heard_;
  std::vector<int> ports_;
};

void run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 4) throw std::runtime_error("usage: stranger DOMAIN COUNT SEED CAPTURE...");
  std::vector<dds::Packet> captured;
  for (std::size_t i = 3; i < arguments.size(); ++i)
    std::ranges::move(dds::captured_datagrams(arguments[i]), std::back_inserter(captured));
  const std::uint64_t count = std::stoull(arguments[1]);
  Attack attack(std::stoi(arguments[0]), std::stoull(arguments[2]), std::move(captured));
  auto next = std::chrono::steady_clock::now();
  for (std::uint64_t sent = 0; count == 0 || sent < count; sent += kAtOnce) {
    attack.send_some();
    std::this_thread::sleep_until(next += kPause);
  }
}

}  // namespace
}  // namespace laneloom

int main(int argc, char** argv) try {
  laneloom::run({argv + 1, argv + argc});
} catch (const std::exception& error) {
  std::fprintf(stderr, "stranger: %s\n", error.what());
  return 1;
}
