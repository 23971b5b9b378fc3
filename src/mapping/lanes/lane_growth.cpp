#include "mapping/lanes/lane_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "mapping/lanes/lane_evidence.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kLongestStep =
    1.6;  // between stations, as a share of LaneConfig::step_m; a longer one is a gap

/// An end of a track, by the track's index.
struct TrackEnd {
  std::size_t track = 0;
  End end = End::back;
};

/// A stretch along which a strip shows a track.
struct Cover {
  Stretch range;                    ///< on the center of the strip
  std::size_t track = 0;            ///< its index
  std::size_t first = 0, last = 0;  ///< the stations at the beginning and at the end of the range
  bool reversed = false;            ///< the strip runs against the track
  double weight = 0.0;              ///< log odds of the stations

  /// The end of the track that the strip passes at one end of the range. Empty: the track goes on there.
  std::optional<TrackEnd> passed(End of_range, const LaneTrack& its_track) const {
    const End end = reversed ? opposite(of_range) : of_range;
    const std::size_t at = of_range == End::front ? first : last;
    const bool is_last = end == End::front ? at == 0 : at + 1 == its_track.stations.size();
    return is_last ? std::optional(TrackEnd{track, end}) : std::nullopt;
  }
};

/// The covers of each strip, along it.
std::vector<std::vector<Cover>> covers_of(const std::vector<std::vector<Match>>& matches,
                                          const std::vector<LaneTrack>& tracks, std::size_t strips,
                                          double longest_step_m) {
  std::vector<std::vector<Cover>> covers(strips);
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    const std::vector<Match>& places = matches[t];
    for (std::size_t i = 0, end = 0; i < places.size(); i = end) {
      end = i + 1;
      if (!places[i].strip) continue;
      double weight = tracks[t].stations[i].log_odds;
      while (end < places.size() && places[end].strip == places[i].strip &&
             places[end].reversed == places[i].reversed &&
             std::abs(places[end].arc_m - places[end - 1].arc_m) < longest_step_m)
        weight += tracks[t].stations[end++].log_odds;
      Cover cover{{places[i].arc_m, places[end - 1].arc_m}, t, i, end - 1, places[i].reversed, weight};
      if (cover.reversed) {
        std::swap(cover.range.from_m, cover.range.to_m);
        std::swap(cover.first, cover.last);
      }
      covers[*places[i].strip].push_back(cover);
    }
  }
  for (std::vector<Cover>& along : covers)
    std::ranges::sort(along, {}, [](const Cover& c) { return std::tuple(c.range.from_m, c.track, c.first); });
  return covers;
}

/// Stations that a track lacks between two others.
struct Filling {
  std::size_t track = 0;
  std::size_t at = 0;  ///< index of the station before which they belong
  std::vector<LaneStation> stations;
};

/// Stations from the end of a track outwards, and the end of another track that they reach.
struct Extension {
  TrackEnd from;
  std::vector<LaneStation> stations;
  std::optional<TrackEnd> to;
};

class Growth {
 public:
  Growth(const LaneConfig& config, std::vector<LaneTrack>& tracks) : config_(config), tracks_(tracks) {}

  /// Takes in one strip with its covers.
  void take_in(const Strip& strip, std::vector<Cover> covers) {
    forget_doubles(covers);
    const Cover* before = nullptr;
    for (const Cover& cover : covers) {
      take_in_gap(strip, before, &cover);
      before = &cover;
    }
    take_in_gap(strip, before, nullptr);
  }

  void apply(markings::IdSource& ids) {
    // The last of a track first, as each moves those behind it.
    std::ranges::sort(fillings_, std::greater(),
                      [](const Filling& one) { return std::pair(one.track, one.at); });
    for (Filling& filling : fillings_) fill(filling);
    std::vector<std::array<TrackEnd, 2>> present;  // where the ends of each track are now
    for (std::size_t t = 0; t < tracks_.size(); ++t)
      present.push_back({TrackEnd{t, End::front}, TrackEnd{t, End::back}});
    for (Extension& extension : extensions_) {
      TrackEnd from = present[extension.from.track][index(extension.from.end)];
      if (!extension.to) {
        extend(std::move(extension.stations), from);
        continue;
      }
      TrackEnd to = present[extension.to->track][index(extension.to->end)];
      if (last_station(to).shown && !last_station(from).shown) {
        std::swap(from, to);
        std::ranges::reverse(extension.stations);
      }
      extend(std::move(extension.stations), from);
      if (to.track == from.track || are_apart(from, to)) continue;
      const bool keeps_from = rank(from) < rank(to);
      const TrackEnd kept = keeps_from ? from : to, gone = keeps_from ? to : from;
      join(kept, gone);
      for (auto& ends : present)
        for (TrackEnd& end : ends)
          if (end.track == gone.track) end = kept;
    }
    for (LaneTrack& track : born_) {
      track.id = ids.next();
      tracks_.push_back(std::move(track));
    }
  }

 private:
  void forget_doubles(std::vector<Cover>& covers) {
    for (std::size_t k = 0; k + 1 < covers.size();) {
      const Cover &a = covers[k], &b = covers[k + 1];
      const double common_m = std::min(a.range.to_m, b.range.to_m) - b.range.from_m;
      if (a.track == b.track || common_m < 1.5 * config_.step_m) {
        ++k;
        continue;
      }
      const std::size_t weaker = a.weight < b.weight ? k : k + 1;
      const auto [from, to] = std::minmax(covers[weaker].first, covers[weaker].last);
      std::vector<LaneStation>& stations = tracks_[covers[weaker].track].stations;
      for (std::size_t i = from; i <= to; ++i) {
        stations[i].log_odds = kForgotten - 1.0;
        stations[i].shown = false;
      }
      covers.erase(covers.begin() + static_cast<std::ptrdiff_t>(weaker));
    }
  }

  /// What a strip says between two covers. Null: there is none before, or behind.
  void take_in_gap(const Strip& strip, const Cover* before, const Cover* behind) {
    if (before != nullptr && behind != nullptr && before->track == behind->track)
      return fill_between(strip, *before, *behind);
    const auto a = before == nullptr ? std::nullopt : before->passed(End::back, tracks_[before->track]);
    const auto b = behind == nullptr ? std::nullopt : behind->passed(End::front, tracks_[behind->track]);
    std::vector<LaneStation> stations = stations_between(strip, before, behind);
    if (a && b) {
      if (is_open(a) && is_open(b)) {
        extensions_.push_back({*a, std::move(stations), b});
      } else if (std::min(before->range.length(), behind->range.length()) > kAside_m) {
        for (const TrackEnd& end : {*a, *b}) parted(end) = std::max(0.0, parted(end) - kPassing);
      }
    } else if (is_open(a) || is_open(b)) {
      if (!is_open(a)) std::ranges::reverse(stations);
      extensions_.push_back({is_open(a) ? *a : *b, std::move(stations), {}});
    } else if (stations.size() > 1 && (a || b || length_of(stations) >= config_.min_length_m)) {
      bear(strip, before, behind, std::move(stations));
    }
  }

  /// Takes what a strip says between two neighbouring stations of a track. A tight bend has left out stations
  /// between them.
  void fill_between(const Strip& strip, const Cover& before, const Cover& behind) {
    const auto [first, second] = std::minmax(before.last, behind.first);
    if (before.reversed != behind.reversed || second != first + 1) return;
    std::vector<LaneStation> stations = stations_between(strip, &before, &behind);
    if (before.reversed) std::ranges::reverse(stations);
    if (!stations.empty()) fillings_.push_back({before.track, second, std::move(stations)});
  }

  void fill(Filling& filling) {
    std::vector<LaneStation>& to = tracks_[filling.track].stations;
    const LaneStation &before = to[filling.at - 1], &behind = to[filling.at];
    continue_lane(before, before.shown && behind.shown, filling.stations);
    to.insert(to.begin() + static_cast<std::ptrdiff_t>(filling.at),
              std::make_move_iterator(filling.stations.begin()),
              std::make_move_iterator(filling.stations.end()));
  }

  /// Makes a track of stations between two covers.
  void bear(const Strip& strip, const Cover* before, const Cover* behind, std::vector<LaneStation> stations) {
    LaneTrack track{.stations = std::move(stations), .section = strip.lane.section};
    if (before == nullptr && strip.is_cut(End::front)) track.parted[0] = kParted;
    if (behind == nullptr && strip.is_cut(End::back)) track.parted[1] = kParted;
    born_.push_back(std::move(track));
  }

  /// Whether a strip passes an end where no other lane begins.
  bool is_open(const std::optional<TrackEnd>& end) { return end && parted(*end) <= 0.0; }

  static double length_of(const std::vector<LaneStation>& stations) { return length(centerline(stations)); }

  double& parted(const TrackEnd& end) { return tracks_[end.track].parted[index(end.end)]; }

  std::vector<LaneStation> stations_between(const Strip& strip, const Cover* before,
                                            const Cover* behind) const {
    const double margin_m = 0.5 * config_.step_m;
    std::vector<LaneStation> stations;
    for (std::size_t i = 0; i < strip.stations.size(); ++i) {
      if (before != nullptr && strip.center.arc_m(i) < before->range.to_m + margin_m) continue;
      if (behind != nullptr && strip.center.arc_m(i) > behind->range.from_m - margin_m) continue;
      stations.push_back(strip.stations[i]);
      stations.back().log_odds = first_evidence(stations.back().status);
    }
    return stations;
  }

  /// Lets stations continue a lane from its last one. What continues a lane that is shown is shown.
  static void continue_lane(const LaneStation& last, bool shown, std::vector<LaneStation>& stations) {
    const auto across = [](const LaneStation& station) -> Eigen::Vector2d {
      return (station.border[1] - station.border[0]).head<2>();
    };
    const bool turned = across(last).dot(across(stations.front())) < 0.0;
    for (LaneStation& station : stations) {
      if (turned) station.swap_sides();
      if (shown) station.log_odds = std::max(station.log_odds, kShown);
    }
  }

  /// Adds stations outwards from an end.
  void extend(std::vector<LaneStation> stations, const TrackEnd& from) {
    if (stations.empty()) return;
    const LaneStation& last = last_station(from);
    continue_lane(last, last.shown, stations);
    append(std::move(stations), from);
  }

  /// Adds stations that run outwards from an end.
  void append(std::vector<LaneStation> stations, const TrackEnd& from) {
    std::vector<LaneStation>& to = tracks_[from.track].stations;
    if (from.end == End::front) {
      std::ranges::reverse(stations);
      stations.insert(stations.end(), std::make_move_iterator(to.begin()), std::make_move_iterator(to.end()));
      to = std::move(stations);
    } else {
      std::ranges::move(stations, std::back_inserter(to));
    }
  }

  /// The track of the lower rank keeps its id where two are joined: one that the last map showed goes first,
  /// and then the older one.
  std::pair<bool, ElementId> rank(const TrackEnd& end) const {
    const LaneTrack& track = tracks_[end.track];
    return {track.published == 0, track.id};
  }

  const LaneStation& last_station(const TrackEnd& end) const {
    const std::vector<LaneStation>& stations = tracks_[end.track].stations;
    return end.end == End::front ? stations.front() : stations.back();
  }

  /// Whether so much is hidden between what two tracks show that they would be parted as soon as they were
  /// joined.
  bool are_apart(const TrackEnd& a, const TrackEnd& b) const {
    const auto at_a = hidden_at(a), at_b = hidden_at(b);
    return at_a && at_b && !is_bridged(*at_a + *at_b, config_);
  }

  /// The number of stations from an end to the first one that will be shown. Empty: none will.
  std::optional<std::size_t> hidden_at(const TrackEnd& end) const {
    const std::vector<LaneStation>& stations = tracks_[end.track].stations;
    const auto count = [](auto begin, auto last) -> std::optional<std::size_t> {
      const auto shown = std::find_if(begin, last, is_to_show);
      return shown == last ? std::nullopt : std::optional(static_cast<std::size_t>(shown - begin));
    };
    return end.end == End::front ? count(stations.begin(), stations.end())
                                 : count(stations.rbegin(), stations.rend());
  }

  void join(const TrackEnd& kept, const TrackEnd& gone) {
    LaneTrack& from = tracks_[gone.track];
    if (gone.end == kept.end) reverse(from);  // from now on, both run alike
    const End far = kept.end;
    LaneTrack& to = tracks_[kept.track];
    to.parted[index(far)] = from.parted[index(far)];
    to.driven = to.driven || from.driven;
    if (far == End::front) std::ranges::reverse(from.stations);
    append(std::move(from.stations), kept);
    from.stations.clear();
  }

  const LaneConfig& config_;
  std::vector<LaneTrack>& tracks_;
  std::vector<Filling> fillings_;
  std::vector<Extension> extensions_;
  std::vector<LaneTrack> born_;
};

}  // namespace

void grow(const std::vector<Strip>& strips, const std::vector<std::vector<Match>>& matches,
          const LaneConfig& config, markings::IdSource& ids, std::vector<LaneTrack>& tracks) {
  std::vector<std::vector<Cover>> covers =
      covers_of(matches, tracks, strips.size(), kLongestStep * config.step_m);
  Growth growth(config, tracks);
  for (std::size_t s = 0; s < strips.size(); ++s) growth.take_in(strips[s], std::move(covers[s]));
  growth.apply(ids);
}

}  // namespace laneloom::lanes
