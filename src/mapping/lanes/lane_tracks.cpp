#include "mapping/lanes/lane_tracks.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "mapping/lanes/lane_evidence.hpp"
#include "mapping/lanes/lane_growth.hpp"
#include "mapping/lanes/lane_reasoning.hpp"
#include "mapping/lanes/lane_strips.hpp"
#include "mapping/lanes/neighbours.hpp"
#include "mapping/lanes/shown_lane.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kMinSpacing = 0.4;     // of stations, as a share of LaneConfig::step_m
constexpr double kNeverThere = -100.0;  // log odds that no frame makes up for
constexpr std::size_t kLookedAt = 8;    // every so many stations tell how the road runs

/// Leaves out stations that do not lie ahead of the one before.
void put_in_row(const LaneConfig& config, std::vector<LaneStation>& stations) {
  for (std::size_t i = 2; i < stations.size();) {
    const auto center = [&](std::size_t k) -> Eigen::Vector2d { return stations[k].center().head<2>(); };
    const Eigen::Vector2d along = (center(i - 1) - center(i - 2)).normalized();
    if ((center(i) - center(i - 1)).dot(along) < kMinSpacing * config.step_m) {
      stations[i - 1].stepped = true;
      stations.erase(stations.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

/// Shows and hides the stations of a track. Short stretches between shown ones are shown.
void show(const LaneConfig& config, std::vector<LaneStation>& stations) {
  for (LaneStation& station : stations) station.shown = is_to_show(station);
  std::size_t last = stations.size();  // that is shown
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (!stations[i].shown) continue;
    if (last < i && is_bridged(i - last - 1, config))
      for (std::size_t k = last + 1; k < i; ++k) stations[k].shown = true;
    last = i;
  }
}

/// Cuts a track into pieces: where it is forgotten, where another lane begins, and between what is shown.
class Pieces {
 public:
  explicit Pieces(LaneTrack track) : stations_(std::exchange(track.stations, {})), whole_(std::move(track)) {
    open(whole_.parted[0]);
    piece_.stations.reserve(stations_.size());  // a track is seldom cut
    bool was_shown = false, was_hidden = false;
    for (LaneStation& station : stations_) {
      if (!station.shown && station.log_odds < kForgotten) {
        close(0.0);
        was_shown = was_hidden = false;
        continue;
      }
      if (station.shown && was_shown && was_hidden) {
        close(0.0);
        was_hidden = false;
      }
      was_hidden = !station.shown;
      was_shown = was_shown || station.shown;
      const double parted = station.parted;
      if (parted >= kParted) station.parted = 0.0;
      piece_.stations.push_back(std::move(station));
      if (parted < kParted) continue;
      close(parted);
      was_shown = was_hidden = false;
    }
    close(whole_.parted[1]);
  }

  /// The pieces. The one that shows most has the id of the whole.
  std::vector<LaneTrack> take(markings::IdSource& ids) {
    if (pieces_.empty()) return {};
    const auto kept = std::ranges::max_element(pieces_, {}, [](const LaneTrack& piece) {
      return std::ranges::count_if(piece.stations, &LaneStation::shown);
    });
    for (LaneTrack& piece : pieces_) {
      if (&piece == &*kept) continue;
      piece.id = ids.next();
      piece.published = 0;
    }
    return std::move(pieces_);
  }

 private:
  void open(double parted) {
    piece_ = whole_;
    piece_.parted = {parted, 0.0};
  }
  void close(double parted) {
    piece_.parted[1] = parted;
    if (piece_.stations.size() > 1) pieces_.push_back(std::move(piece_));
    open(parted);
  }

  std::vector<LaneStation> stations_;
  LaneTrack whole_, piece_;  ///< the whole has no stations any more
  std::vector<LaneTrack> pieces_;
};

/// Whether stations run against most of the boundaries beside them, which run as the sections of the road do.
bool runs_against_road(const std::vector<LaneStation>& stations, const boundaries::Boundaries& boundaries) {
  double along = 0.0;
  for (std::size_t i = 0; i + 1 < stations.size(); i += kLookedAt) {
    const Eigen::Vector2d ahead = (stations[i + 1].center() - stations[i].center()).head<2>().normalized();
    for (const Side side : kSides) {
      const boundaries::LaneBoundary* boundary = boundaries.find(stations[i].boundary[index(side)]);
      if (boundary == nullptr) continue;
      const Projection foot = boundary->course.project(stations[i].border[index(side)]);
      along += boundary->course.direction(foot).dot(ahead);
    }
  }
  return along < 0.0;
}

}  // namespace

LaneLayout LaneTracks::update(LaneLayout found, const geometry::Scene& scene, const LaneConfig& config,
                              markings::IdSource& ids, FrameReasons* reasons) {
  LaneReasoning reasoning(reasons, tracks_);
  std::vector<Strip> strips;
  strips.reserve(found.lanes.size());
  for (const Lane& lane : found.lanes) strips.emplace_back(lane, found.forks);
  std::vector<std::vector<Match>> matches;
  matches.reserve(tracks_.size());
  for (LaneTrack& track : tracks_) {
    matches.push_back(match(track, strips, found));
    observe(strips, matches.back(), config, track);
    reasoning.observed(track, matches.back());
  }
  grow(strips, matches, config, ids, tracks_);
  std::vector<LaneTrack> whole = std::exchange(tracks_, {});
  for (LaneTrack& track : whole) {
    std::erase_if(track.stations, [&](const LaneStation& s) { return !scene.box.keeps(s.center()); });
    put_in_row(config, track.stations);
    show(config, track.stations);
    std::ranges::move(Pieces(std::move(track)).take(ids), std::back_inserter(tracks_));
  }
  std::ranges::sort(tracks_, {}, &LaneTrack::id);
  found.lanes.clear();
  for (LaneTrack& track : tracks_) {
    if (runs_against_road(track.stations, found.boundaries)) reverse(track);
    auto lane = shown_lane(track, found.boundaries);
    reasoning.decided(track, lane);
    if (!lane) {
      track.published = 0;
      continue;
    }
    track.begin = lane->centerline.front();
    found.lanes.push_back(std::move(*lane));
  }
  reasoning.ended(tracks_, scene.box);
  find_neighbours(found);
  return found;
}

LaneLayout LaneTracks::adopt(LaneLayout found, markings::IdSource& ids) {
  for (Lane& lane : found.lanes) {
    lane.id = ids.next();
    tracks_.push_back({.id = lane.id});
  }
  find_neighbours(found);
  return found;
}

void LaneTracks::forget(const std::function<bool(const Point&)>& is_gone) {
  for (LaneTrack& track : tracks_)
    for (LaneStation& station : track.stations)
      if (is_gone(station.center())) station.log_odds = kNeverThere;
}

void LaneTracks::move(const Eigen::Isometry3d& motion) {
  for (LaneTrack& track : tracks_) {
    for (LaneStation& station : track.stations)
      for (Point& border : station.border) border = motion * border;
    track.begin = motion * track.begin;
  }
}

KnownBorders LaneTracks::known_borders() const {
  KnownBorders known;
  for (const LaneTrack& track : tracks_)
    for (const LaneStation& station : track.stations)
      if (station.shown) known.insert(station.boundary);
  return known;
}

const LaneTrack* LaneTracks::find(ElementId id) const {
  const auto found = std::ranges::find(tracks_, id, &LaneTrack::id);
  return found == tracks_.end() ? nullptr : &*found;
}

LaneTrack* LaneTracks::find(ElementId id) {
  return const_cast<LaneTrack*>(std::as_const(*this).find(id));  // NOLINT: of these tracks
}

std::map<ElementId, ElementId> LaneTracks::publish(const std::vector<Lane>& lanes, markings::IdSource& ids) {
  std::map<ElementId, ElementId> renamed;
  for (const Lane& lane : lanes) {
    LaneTrack* track = find(lane.id);
    if (track == nullptr) continue;
    if (lane.centerline.front() != track->begin) reverse(*track);
    if (track->published < 0) {
      track->id = ids.next();
      renamed.emplace(lane.id, track->id);
    }
    track->told_direction = lane.direction == Lane::Direction::along_centerline ? 1 : 0;
    track->published = 1;
  }
  std::ranges::sort(tracks_, {}, &LaneTrack::id);
  return renamed;
}

}  // namespace laneloom::lanes
