#include "mapping/lines/networks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/seconds.hpp"
#include "laneloom/error.hpp"
#include "laneloom/limits.hpp"

namespace laneloom::lines {
namespace {

constexpr double kNewPlace_m = 0.3;
constexpr double kViewsInARow = 20.0;  // from one place; then the views pause
constexpr double kPause_s = 0.95;      // a second, less what frames jitter
constexpr double kLeastNews = 0.3;     // of a view right after another one; after a pause it is a whole one

}  // namespace

bool Standpoint::stands(const Point& origin) const {
  return views_ > 0.0 && (origin - place_).head<2>().norm() < kNewPlace_m;
}

bool Standpoint::follows(std::int64_t stamp_ns) const {
  return std::abs(seconds(stamp_ns - last_view_ns_)) < kPause_s;
}

bool Standpoint::has_seen(const Point& origin, std::int64_t stamp_ns) const {
  return views_ >= kViewsInARow && stands(origin) && follows(stamp_ns);
}

double Standpoint::news(const Point& origin, std::int64_t stamp_ns) {
  paused_ = views_ > 0.0 && !follows(stamp_ns);
  last_view_ns_ = stamp_ns;
  if (stands(origin)) {
    views_ += 1.0;
    return 1.0 / (views_ * views_);
  }
  place_ = origin;
  views_ = 1.0;
  return 1.0;
}

double Standpoint::least_news() const { return paused_ ? 1.0 : kLeastNews; }

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
                .standpoint = {},
                .pitch = {}};
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
