#include "mapping/lanes/lane_strips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mapping/geometry/levels.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kSameLane_m = 0.8;     // between centers; further aside lies another lane
constexpr double kSameBorders_m = 0.3;  // by which a lane between the same boundaries is taken to be nearer
constexpr double kMinAgreement = 0.87;  // cosine between a lane and the same lane in another frame
constexpr std::size_t kMinInARow = 3;   // stations that a strip shows
constexpr double kCut_m = 2.0;          // from a fork to the end of a lane that was cut there

LaneStation between(const LaneStation& a, const LaneStation& b, double share) {
  LaneStation station = share < 0.5 ? a : b;
  for (const Side side : kSides) {
    const Point &from = a.border[index(side)], &to = b.border[index(side)];
    station.border[index(side)] = from + share * (to - from);
  }
  return station;
}

bool is_cut_at(const Lane& lane, End end, const Fork& fork) {
  return std::ranges::any_of(kSides, [&](Side one) {
    const LaneSide side = side_at_end(lane, one, end);
    const double end_m = end == End::back ? side.end_m() : side.begin_m();
    return side.of == fork.branch.other() && std::abs(end_m - fork.arc_m) < kCut_m;
  });
}

bool is_inferred_at(const Lane& lane, double arc_m) {
  return lane.status == ElementStatus::inferred ||
         std::ranges::any_of(lane.inferred_ranges, [&](const Stretch& range) {
           return range.from_m <= arc_m && arc_m <= range.to_m;
         });
}

/// Finds the places of the stations of one track.
class Matching {
 public:
  explicit Matching(const LaneTrack& track)
      : stations_(track.stations),
        centers_(centerline(track.stations)),
        box_(box_around(centers_)),
        matches_(stations_.size()),
        misfit_m_(stations_.size(), std::numeric_limits<double>::infinity()) {}

  void consider(const Strip& strip, std::size_t its_index) {
    if (!strip.box.intersects(box_)) return;
    const double reach_m = std::max(kSameLane_m, 0.5 * strip.lane.width_m);
    MeasuredPolyline::Cursor along(strip.center);
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      if (!strip.box.contains(centers_[i])) continue;
      const Projection foot = along.project(centers_[i], reach_m);
      if (!foot.inside || !geometry::same_level(foot.foot, centers_[i])) continue;
      const double cosine = direction(i).dot(strip.center.direction(foot));
      if (std::abs(cosine) < kMinAgreement) continue;
      if (foot.distance_m >= kSameLane_m) {
        matches_[i].is_taken = true;
        continue;
      }
      const double misfit_m = foot.distance_m - (has_borders_of(stations_[i], strip) ? kSameBorders_m : 0.0);
      if (misfit_m >= misfit_m_[i]) continue;
      misfit_m_[i] = misfit_m;
      matches_[i].strip = its_index;
      matches_[i].arc_m = foot.arc_m;
      matches_[i].reversed = cosine < 0.0;
    }
  }

  /// Marks the stations between two boundaries along a line in their middle.
  void mark(const std::array<ElementId, 2>& borders, const Polyline& line, bool Match::*what) {
    const auto is_between = [&](const LaneStation& station) { return between(station, borders); };
    if (std::ranges::none_of(stations_, is_between)) return;
    const MeasuredPolyline middle(line);
    MeasuredPolyline::Cursor along(middle);
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      if (!is_between(stations_[i])) continue;
      const Projection foot = along.project(centers_[i], kSameLane_m);
      if (foot.inside && foot.distance_m < kSameLane_m) matches_[i].*what = true;
    }
  }

  /// The places. A strip that shows only a few stations in a row is left out: of two strips that overlap, it
  /// is nearer by chance. What lies between stations that one strip shows is shown by it as well.
  std::vector<Match> take() {
    for (std::size_t i = 0, end = 0; i < matches_.size(); i = end) {
      end = i + 1;
      while (end < matches_.size() && matches_[end].strip == matches_[i].strip) ++end;
      if (end - i < std::min(kMinInARow, matches_.size())) replace(i, end);
    }
    return std::move(matches_);
  }

 private:
  Eigen::Vector2d direction(std::size_t i) const {
    const std::size_t k = std::min(i, centers_.size() - 2);
    return (centers_[k + 1] - centers_[k]).head<2>().normalized();
  }
  void replace(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) matches_[i].strip.reset();
    if (begin == 0 || end == matches_.size()) return;
    const Match &before = matches_[begin - 1], &behind = matches_[end];
    if (!before.strip || before.strip != behind.strip || before.reversed != behind.reversed) return;
    for (std::size_t i = begin; i < end; ++i) {
      const double share = static_cast<double>(i + 1 - begin) / static_cast<double>(end + 1 - begin);
      matches_[i] = {before.strip, before.arc_m + share * (behind.arc_m - before.arc_m), before.reversed};
    }
  }
  static bool between(const LaneStation& station, const std::array<ElementId, 2>& borders) {
    return borders == station.boundary || std::array{borders[1], borders[0]} == station.boundary;
  }
  static bool has_borders_of(const LaneStation& station, const Strip& strip) {
    return between(station, {strip.boundary(Side::left), strip.boundary(Side::right)});
  }

  const std::vector<LaneStation>& stations_;
  Polyline centers_;
  Box box_;
  std::vector<Match> matches_;
  std::vector<double> misfit_m_;
};

}  // namespace

Strip::Strip(const Lane& found, const std::vector<Fork>& forks)
    : lane(found), center(found.centerline), box(box_around(found.centerline, found.width_m)) {
  const MeasuredPolyline left(found.left), right(found.right);
  MeasuredPolyline::Cursor along_left(left), along_right(right);
  stations.reserve(center.points().size());
  for (std::size_t i = 0; i < center.points().size(); ++i) {
    const Point& middle = center.points()[i];
    stations.push_back(
        {.border = {along_left.project(middle).foot, along_right.project(middle).foot},
         .boundary = {boundary(Side::left), boundary(Side::right)},
         .probability = found.existence_probability,
         .status = is_inferred_at(found, center.arc_m(i)) ? ElementStatus::inferred : found.status,
         .evidence = found.evidence,
         .found = true});
  }
  for (const End end : kEnds)
    cut[index(end)] =
        std::ranges::any_of(forks, [&](const Fork& fork) { return is_cut_at(found, end, fork); });
}

LaneStation Strip::at(double at_m) const {
  const std::size_t i = center.first_beyond(at_m);
  if (i == 0) return stations.front();
  if (i == stations.size()) return stations.back();
  const double before_m = center.arc_m(i - 1);
  return between(stations[i - 1], stations[i], (at_m - before_m) / (center.arc_m(i) - before_m));
}

std::vector<Match> match(const LaneTrack& track, const std::vector<Strip>& strips, const LaneLayout& found) {
  Matching matching(track);
  for (const DeniedStretch& stretch : found.denied)
    matching.mark(stretch.borders, stretch.middle, &Match::is_denied);
  for (const Lane& strip : found.side_strips)
    matching.mark({strip.left_borders.front().boundary, strip.right_borders.front().boundary},
                  strip.centerline, &Match::is_taken);
  for (std::size_t s = 0; s < strips.size(); ++s) matching.consider(strips[s], s);
  return matching.take();
}

}  // namespace laneloom::lanes
