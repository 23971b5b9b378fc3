// stranger [--only NAME] DOMAIN COUNT SEED CAPTURE...: sends COUNT damaged datagrams (0: until it is told to
// end). They are made of those in the CAPTUREs (tests/dds/captures). They go to all ports of a domain, most
// in the names of participants that are heard there. With NAME they go to the participants that are called
// so, and in nobody's name who is there: what is said in the name of another one ends that one's streams.
#include "stranger.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
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
// A busy host has no time for more beside everything else. The stranger is to damage, not to flood.
constexpr std::chrono::milliseconds kPauseOfOneTarget{50};
constexpr std::ptrdiff_t kPrefixAt = 8;
constexpr std::uint8_t kInfoDestination = 0x0e;

volatile std::sig_atomic_t told_to_end = 0;

struct Target {
  int domain;
  std::string_view only;  ///< to those of this name; empty: to all
};

class Attack {
 public:
  Attack(Target target, std::uint64_t seed, std::vector<dds::Packet> captured)
      : to_all_(target.only.empty()),
        stranger_(target.domain),
        eavesdropper_(target.domain, target.only),
        mutation_(std::move(captured), seed) {}

  void send_some() {
    heard_ = eavesdropper_.participants();
    ports_ = to_all_ ? stranger_.ports() : eavesdropper_.ports();
    if (!to_all_ && ports_.empty()) return;
    for (std::uint64_t i = 0; i < kAtOnce; ++i) send(next());
  }

 private:
  dds::Packet next() {
    const auto& originals = mutation_.originals();
    dds::Packet packet = originals[mutation_.below(originals.size())];
    if (!heard_.empty() && mutation_.below(8) > 0) address(packet);
    mutation_.damage(packet);
    return packet;
  }

  /// Speaks to one who was heard, and in the name of another one.
  void address(dds::Packet& packet) {
    if (to_all_) put(packet, kPrefixAt);
    constexpr std::ptrdiff_t kHeaderBytes = 20, kSubmessageHeaderBytes = 4;
    if (packet.size() > kHeaderBytes && packet[kHeaderBytes] == kInfoDestination)
      put(packet, kHeaderBytes + kSubmessageHeaderBytes);
  }
  void put(dds::Packet& packet, std::ptrdiff_t at) {
    std::ranges::copy(heard_[mutation_.below(heard_.size())], packet.begin() + at);
  }

  void send(const dds::Packet& packet) {
    const std::size_t to = mutation_.below(ports_.size() + (to_all_ ? 1 : 0));
    if (to == ports_.size()) return stranger_.send_to_all(packet);
    stranger_.send_to(ports_[to], packet);
  }

  bool to_all_;
  Stranger stranger_;
  Eavesdropper eavesdropper_;
  Mutation mutation_;
  std::vector<dds::Prefix> heard_;
  std::vector<int> ports_;
};

void run(std::vector<std::string> arguments) {
  std::string only;
  if (arguments.size() > 1 && arguments[0] == "--only") {
    only = arguments[1];
    arguments.erase(arguments.begin(), arguments.begin() + 2);
  }
  if (arguments.size() < 4)
    throw std::runtime_error("usage: stranger [--only NAME] DOMAIN COUNT SEED CAPTURE...");
  std::vector<dds::Packet> captured;
  for (std::size_t i = 3; i < arguments.size(); ++i)
    std::ranges::move(dds::captured_datagrams(arguments[i]), std::back_inserter(captured));
  const std::uint64_t count = std::stoull(arguments[1]);
  Attack attack({std::stoi(arguments[0]), only}, std::stoull(arguments[2]), std::move(captured));
  const auto pause = only.empty() ? kPause : kPauseOfOneTarget;
  auto next = std::chrono::steady_clock::now();
  for (std::uint64_t sent = 0; told_to_end == 0 && (count == 0 || sent < count); sent += kAtOnce) {
    attack.send_some();
    std::this_thread::sleep_until(next += pause);
  }
}

}  // namespace
}  // namespace laneloom

int main(int argc, char** argv) try {
  std::signal(SIGTERM, [](int) { laneloom::told_to_end = 1; });
  laneloom::run({argv + 1, argv + argc});
} catch (const std::exception& error) {
  std::fprintf(stderr, "stranger: %s\n", error.what());
  return 1;
}
