#include "mapping/lines/networks.hpp"

#include <algorithm>
#include <iterator>

#include "laneloom/limits.hpp"

namespace laneloom {
namespace {

constexpr double kNewPlace_m = 0.3;

}  // namespace

double Standpoint::news(const Point& origin) {
  if (views_ > 0.0 && (origin - place_).head<2>().norm() < kNewPlace_m) {
    views_ += 1.0;
    return 1.0 / (views_ * views_);
  }
  place_ = origin;
  views_ = 1.0;
  return 1.0;
}

std::size_t Networks::number(const std::string& source, std::uint64_t frame, const FusionConfig& config) {
  auto network = std::ranges::find(networks_, source, &Network::source);
  if (network == networks_.end()) {
    if (networks_.size() < kSourcesAtATime) networks_.emplace_back();  // of frame 0: before all others
    network = std::ranges::min_element(networks_, {}, &Network::frame);
    *network = {
        .source = source, .frame = frame, .lateral = NetworkModel(config), .detection = {}, .standpoint = {}};
  }
  network->frame = frame;
  return static_cast<std::size_t>(std::distance(networks_.begin(), network));
}

const Network* Networks::find(const std::string& source) const {
  const auto network = std::ranges::find(networks_, source, &Network::source);
  return network != networks_.end() ? &*network : nullptr;
}

}  // namespace laneloom
