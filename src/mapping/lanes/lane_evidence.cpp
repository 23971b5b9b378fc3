#include "mapping/lanes/lane_evidence.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace laneloom::lanes {
namespace {

constexpr double kMost = 5.0;           // of a lane between seen borders
constexpr double kMostInferred = 2.5;   // of another one
constexpr double kMissed = 0.1;         // of a frame that does not find the lane
constexpr double kDenied = 0.25;        // of a frame that shows the borders, and says that no lane lies there
constexpr double kTaken = 0.8;          // of a frame that finds another lane in its place
constexpr double kParting = 0.5;        // of a frame in which one lane ends and another one begins
constexpr double kBridged_m = 8.0;      // a longer stretch that is not believed parts a lane
constexpr double kCorrection_m = 20.0;  // over which a correction of what was found reaches what was not

/// What a later frame that finds a lane says.
double gain(ElementStatus status) { return status == ElementStatus::confirmed ? 0.5 : 0.25; }

/// Moves a station to where a strip shows it.
void move_to(const Strip& strip, const Match& at, LaneStation& station) {
  LaneStation now = strip.at(at.arc_m);
  if (at.reversed) now.swap_sides();
  const double most = now.status == ElementStatus::inferred ? kMostInferred : kMost;
  now.log_odds = std::max(station.log_odds, std::min(most, station.log_odds + gain(now.status)));
  now.parted = station.parted;
  now.stepped = station.stepped;
  now.shown = station.shown;
  station = now;
}

/// A shift, and how far it counts.
struct Shift {
  Point by = Point::Zero();
  double weight = 0.0;
};

/// Moves stations that were not found with the nearest ones that were. `shifts` are those of the latter.
void correct(const std::vector<std::optional<Point>>& shifts, const LaneConfig& config,
             std::vector<LaneStation>& stations) {
  const double fading = config.step_m / kCorrection_m;
  std::vector<Shift> before(stations.size());
  Shift last;
  const auto follow = [&](const std::optional<Point>& shift) {
    last = shift ? Shift{*shift, 1.0} : Shift{last.by, std::max(0.0, last.weight - fading)};
    return last;
  };
  for (std::size_t i = 0; i < stations.size(); ++i) before[i] = follow(shifts[i]);
  last = {};
  for (std::size_t i = stations.size(); i-- > 0;) {
    const Shift behind = follow(shifts[i]);
    const double sum = before[i].weight + behind.weight;
    if (shifts[i] || sum <= 0.0) continue;
    const auto square = [](double x) { return x * x; };
    const Point by = (square(before[i].weight) * before[i].by + square(behind.weight) * behind.by) / sum;
    for (Point& border : stations[i].border) border += by;
  }
}

/// Whether a strip shows a track over some length from a station on.
bool lasts(const std::vector<Match>& matches, std::size_t from, bool backwards, const LaneConfig& config) {
  const auto count = static_cast<std::size_t>(kAside_m / config.step_m);
  for (std::size_t k = 1; k < count; ++k) {
    const std::size_t i = backwards ? from - k : from + k;
    if (i >= matches.size() || matches[i].strip != matches[from].strip) return false;
  }
  return true;
}

/// Weighs where one lane ends and another one begins, and marks where the borders may step aside.
void observe_changes(const std::vector<Strip>& strips, const std::vector<Match>& matches,
                     const LaneConfig& config, std::vector<LaneStation>& stations) {
  for (std::size_t i = 0; i + 1 < matches.size(); ++i) {
    const Match &a = matches[i], &b = matches[i + 1];
    LaneStation& station = stations[i];
    if (a.strip != b.strip) station.stepped = true;
    if (!a.strip || !b.strip) continue;
    if (a.strip == b.strip) {
      station.stepped = false;
      station.parted = std::max(0.0, station.parted - kPassing);
    } else if (strips[*a.strip].is_cut(a.reversed ? End::front : End::back) &&
               strips[*b.strip].is_cut(b.reversed ? End::back : End::front) &&
               lasts(matches, i, true, config) && lasts(matches, i + 1, false, config)) {
      station.parted = std::min(kMostParted, station.parted + kParting);
    }
  }
}

}  // namespace

bool is_to_show(const LaneStation& station) { return station.log_odds >= (station.shown ? kHidden : kShown); }

bool is_bridged(std::size_t hidden, const LaneConfig& config) {
  return static_cast<double>(hidden) * config.step_m <= kBridged_m;
}

double first_evidence(ElementStatus status) {
  if (status == ElementStatus::inferred) return 0.0;
  return status == ElementStatus::confirmed ? 1.5 : kShown;
}

void observe(const std::vector<Strip>& strips, const std::vector<Match>& matches, const LaneConfig& config,
             LaneTrack& track) {
  std::vector<std::optional<Point>> shifts(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    LaneStation& station = track.stations[i];
    if (!matches[i].strip) {
      station.found = false;
      station.log_odds -= matches[i].is_taken ? kTaken : matches[i].is_denied ? kDenied : kMissed;
      continue;
    }
    const Strip& strip = strips[*matches[i].strip];
    const Point before = station.center();
    move_to(strip, matches[i], station);
    shifts[i] = station.center() - before;
    track.section = strip.lane.section;
  }
  correct(shifts, config, track.stations);
  observe_changes(strips, matches, config, track.stations);
}

}  // namespace laneloom::lanes
