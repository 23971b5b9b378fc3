#include "mapping/lines/networks.hpp"

#include <algorithm>
#include <iterator>

#include "laneloom/error.hpp"
#include "laneloom/limits.hpp"

namespace laneloom::lines {
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

NetworkProfile Network::profile() const {
  NetworkProfile profile = lateral.profile();
  profile.merge(detection.profile());
  std::erase_if(profile, [](const auto& value) { return value.second.weight <= 0.0; });
  return profile;
}

std::size_t Networks::number(const std::string& source, std::uint64_t frame, const MapperConfig& config) {
  auto network = std::ranges::find(networks_, source, &Network::source);
  if (network == networks_.end()) {
    if (networks_.size() < kSourcesAtATime) networks_.emplace_back();  // its frame 0 makes it the oldest
    network = std::ranges::min_element(networks_, {}, &Network::frame);
    const auto known = config.networks.find(source);
    const NetworkProfile profile = known != config.networks.end() ? known->second : NetworkProfile{};
    *network = {.source = source,
                .frame = frame,
                .lateral = NetworkModel(config.fusion, profile),
                .detection = DetectionModel(profile),
                .standpoint = {}};
  }
  network->frame = frame;
  return static_cast<std::size_t>(std::distance(networks_.begin(), network));
}

const Network* Networks::find(const std::string& source) const {
  const auto network = std::ranges::find(networks_, source, &Network::source);
  return network != networks_.end() ? &*network : nullptr;
}

void check_profiles(const MapperConfig& config) {
  NetworkProfile known = NetworkModel(config.fusion).profile();
  known.merge(DetectionModel().profile());
  for (const auto& [source, profile] : config.networks)
    for (const auto& [name, value] : profile)
      if (!known.contains(name))
        throw ConfigError(std::string(config.fusion.profile_file)
                              .append(": ")
                              .append(source)
                              .append(".")
                              .append(name)
                              .append(" is not a value that is learned of a network"));
}

}  // namespace laneloom::lines
