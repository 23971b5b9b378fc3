#include "mapping/lanes/hypotheses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "mapping/geometry/levels.hpp"
#include "mapping/lanes/gores.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kStraddled_m = 1.0;  // a lane does not straddle a line that lies further within it

constexpr double kLeastParted_m = 2.0;  // a line parts two boundaries if it lies that far from each

constexpr double kMinWidth_m = 0.8, kMaxWidth_m = 8.5;  // of a lane
constexpr double kMinDivided_m = 4.0;                   // width of two lanes
constexpr double kMinRoom_m = 5.0;                      // beside one mark
constexpr std::size_t kTaperReach = 3;                  // cross-sections either way
constexpr double kBeyondEnd_m =
    10.0;                          // up to here before or behind a boundary, the vehicle counts as beside it
constexpr double kAsDriven = 0.9;  // cosine between its heading and the boundary
constexpr double kDrivenFrom = 0.2;  // of a lane's width, from its borders to the vehicle
constexpr double kHere_m = 12.0;     // from a cross-section to the vehicle that drives there
constexpr double kUnseen_m = 15.0;   // along the road, up to where a line goes on unseen
constexpr double kBegin = 4.0;       // log odds that it takes for a lane to begin, or to end
constexpr double kLeastPlace = -4.0, kMostPlace = 4.0;  // log odds that a single place can say
constexpr double kOuterOfTwo =
    -0.1;  // beyond that, among the surest: of two lines side by side, the inner one is the border

/// The place of the vehicle beside boundaries.
class VehicleBeside {
 public:
  VehicleBeside(const MeasuredPolyline& line, bool reversed, const Eigen::Isometry3d& T_map_body)
      : vehicle_(T_map_body.translation()), foot_(line.project(vehicle_)), ahead_(line.direction(foot_)) {
    if (reversed) {
      foot_.lateral_m = -foot_.lateral_m;
      ahead_ = -ahead_;
    }
    const double beyond_m2 = foot_.distance_m * foot_.distance_m - foot_.lateral_m * foot_.lateral_m;
    const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>();
    is_beside_ = beyond_m2 < kBeyondEnd_m * kBeyondEnd_m && geometry::may_drive_on(foot_.foot, vehicle_) &&
                 std::abs(ahead_.dot(heading)) > kAsDriven * heading.norm();
  }

  /// Whether the vehicle drives in a lane, or in one of two, between the boundary and another one on its
  /// left.
  bool is_left_up_to(const MeasuredPolyline& other, Room room) const {
    if (!is_beside_) return false;
    const Projection foot = other.project(vehicle_, kStreetReach_m);
    if (foot.distance_m >= kStreetReach_m) return false;
    const double sense = other.direction(foot).dot(ahead_) > 0.0 ? 1.0 : -1.0;
    const double width_m = foot_.lateral_m - sense * foot.lateral_m;
    const double margin = room == Room::between ? kDrivenFrom : 0.5 * kDrivenFrom;
    return is_within(foot_.lateral_m, width_m, margin);
  }
  bool is_in_width(double width_m) const {
    return is_beside_ && is_within(foot_.lateral_m, width_m, kDrivenFrom);
  }
  bool is_near(const Point& place) const {
    return (place - vehicle_).head<2>().squaredNorm() < kHere_m * kHere_m;
  }
  bool is_in_open(Room room, double width_m) const {
    return is_beside_ &&
           is_within(room == Room::open_left ? foot_.lateral_m : -foot_.lateral_m, width_m, kDrivenFrom);
  }

 private:
  static bool is_within(double lateral_m, double width_m, double margin) {
    return width_m > 0.0 && std::min(lateral_m, width_m - lateral_m) > margin * width_m;
  }

  Point vehicle_;
  Projection foot_;
  Eigen::Vector2d ahead_;
  bool is_beside_ = false;
};

/// Whether a boundary that rather is there than not lies between a mark and the cut boundary, that far from
/// either.
bool is_parted(const RoadCut& cut, std::size_t left, double least_aside_m) {
  for (std::size_t i = cut.own + 1; i < left; ++i) {
    const Mark& mark = cut.marks[i];
    const double aside_m = std::min(mark.lateral_m, cut.marks[left].lateral_m - mark.lateral_m);
    if (mark.log_odds > 0.0 && aside_m >= least_aside_m) return true;
  }
  return false;
}

/// Collects the candidates of cross-sections to hypotheses.
class Collection {
 public:
  Collection(std::size_t base, bool reversed, std::size_t cuts)
      : base_(base), reversed_(reversed), cuts_(cuts) {}

  void add(std::size_t cut, Room room, std::size_t other, std::size_t mark) {
    const auto goes_on = [&](const Hypothesis& one) {
      return one.room == room && one.other == other && one.first + one.marks.size() == cut;
    };
    auto last = std::ranges::find_if(all_, goes_on);
    if (last == all_.end()) {
      all_.push_back({.room = room, .base = base_, .reversed = reversed_, .other = other, .first = cut});
      last = all_.end() - 1;
      last->marks.reserve(cuts_ - cut);
    }
    last->marks.push_back(mark);
  }

  std::vector<Hypothesis> take() {
    std::ranges::sort(all_, {},
                      [](const Hypothesis& one) { return std::tuple(one.room, one.other, one.first); });
    return std::move(all_);
  }

 private:
  std::size_t base_;
  bool reversed_;
  std::size_t cuts_;  ///< their number
  std::vector<Hypothesis> all_;
};

/// The mark on the other side of the room of a candidate. Null: an open lane's room has none.
const Mark* across(const RoadCut& cut, const Candidate& candidate) {
  if (candidate.room == Room::open_left)
    return candidate.left + 1 < cut.marks.size() ? &cut.marks[candidate.left + 1] : nullptr;
  if (candidate.room == Room::open_right)
    return candidate.right > 0 ? &cut.marks[candidate.right - 1] : nullptr;
  return &cut.marks[candidate.left];
}

/// A place of a hypothesis.
struct Place {
  RoadCut cut;
  Candidate candidate;
  double width_m = 0.0;
  const Mark* across = nullptr;  ///< see across()
};

void list_places(const Hypothesis& hypothesis, const RoadCuts& cuts, std::vector<Place>& places) {
  places.clear();
  for (std::size_t i = 0; i < hypothesis.marks.size(); ++i) {
    Place place{.cut = cuts[hypothesis.first + i], .candidate = {.room = hypothesis.room}};
    place.candidate.right = place.cut.own;
    place.candidate.left = is_open(hypothesis.room) ? place.cut.own : hypothesis.marks[i];
    place.width_m = width_m(place.cut, place.candidate);
    place.across = across(place.cut, place.candidate);
    places.push_back(place);
  }
}

double taper_at(std::span<const Place> places, std::size_t i, double step_m) {
  const std::size_t from = i < kTaperReach ? 0 : i - kTaperReach;
  const std::size_t to = std::min(i + kTaperReach, places.size() - 1);
  if (from == to) return 0.0;
  return std::abs(places[to].width_m - places[from].width_m) / (step_m * static_cast<double>(to - from));
}

/// The places that lie in a gore. `between` is scratch.
GorePlaces gore_places(std::span<const Place> places, std::vector<PlaceBetween>& between) {
  const auto may_be_crossed = [](const Mark* mark) {
    return mark != nullptr && !mark->is_edge && mark->dashed >= 0.0;
  };
  between.clear();
  for (const Place& place : places)
    between.push_back({.along_m = place.cut.self().arc_m,
                       .width_m = place.width_m,
                       .may_be_crossed = may_be_crossed(&place.cut.self()) || may_be_crossed(place.across)});
  return in_gore(between);
}

/// How near along the cut boundary a line parts it from another boundary: from 1 to 0 per cross-section. A
/// line does so that rather is there than not.
void find_parted(std::size_t other, const RoadCuts& cuts, double step_m, std::vector<double>& parted) {
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const RoadCut cut = cuts[c];
    const std::span<const Mark> marks = cut.marks;
    const auto at =
        static_cast<std::size_t>(std::ranges::find(marks, other, &Mark::boundary) - marks.begin());
    if (at == marks.size()) continue;
    const auto [right, left] = std::minmax(at, cut.own);
    for (std::size_t i = right + 1; i < left; ++i) {
      const double aside_m =
          std::min(marks[i].lateral_m - marks[right].lateral_m, marks[left].lateral_m - marks[i].lateral_m);
      if (marks[i].log_odds > 0.0 && aside_m >= kLeastParted_m) parted[c] = 1.0;
    }
  }
  const double fading = step_m / kUnseen_m;
  for (std::size_t c = 1; c < parted.size(); ++c) parted[c] = std::max(parted[c], parted[c - 1] - fading);
  for (std::size_t c = parted.size() - 1; c-- > 0;) parted[c] = std::max(parted[c], parted[c + 1] - fading);
}

/// Whether a mark is of the cut edge itself, where it has turned back, as at the end of a street.
bool is_other_side(const RoadCut& cut, const Mark& mark) {
  return mark.is_edge && mark.boundary == cut.self().boundary && mark.arc_m > cut.self().arc_m;
}

/// Adds the candidates between the cut boundary and those on its left that are wanted: of two opposed
/// boundaries, the older one is the one that is cut.
template <class IsWanted>
void add_on_left(const RoadCut& cut, std::size_t at, const LaneConfig& config, Collection& collection,
                 const IsWanted& is_wanted) {
  for (std::size_t left = cut.own + 1; left < cut.marks.size(); ++left) {
    const Mark& mark = cut.marks[left];
    if (mark.lateral_m < kMinWidth_m) continue;
    if (is_parted(cut, left, kStraddled_m)) return;
    if (!is_wanted(mark)) continue;
    if (mark.lateral_m < kMaxWidth_m) collection.add(at, Room::between, mark.boundary, left);
    if (config.unmarked_roads && mark.lateral_m > kMinDivided_m && !is_parted(cut, left, kBesideBorder_m))
      collection.add(at, Room::divided, mark.boundary, left);
  }
}

/// Whether a vehicle drives in a lane of a hypothesis with these places.
bool drives_in(const VehicleBeside& vehicle, const Hypothesis& one, std::span<const Place> places,
               const boundaries::SectionGraph& road, const LaneConfig& config) {
  if (is_open(one.room)) return vehicle.is_in_open(one.room, config.assumed_width_m);
  if (one.other != one.base) return vehicle.is_left_up_to(road.boundaries[one.other].course, one.room);
  return std::ranges::any_of(places, [&](const Place& place) {
    return vehicle.is_near(place.cut.self().point) && vehicle.is_in_width(place.width_m);
  });
}

/// Whether a vehicle drives between the mark of an open lane and the next one, `room_m` away.
bool drives_in_room(std::span<const VehicleBeside> vehicles, Room room, double room_m) {
  return is_open(room) && std::ranges::any_of(vehicles, [&](const VehicleBeside& vehicle) {
           return vehicle.is_in_open(room, room_m);
         });
}

bool is_near(std::span<const VehicleBeside> vehicles, const Point& place) {
  return std::ranges::any_of(vehicles, [&](const VehicleBeside& vehicle) { return vehicle.is_near(place); });
}

/// Gives a hypothesis the log odds that strips for others than cars lie there. Its marks are of one kind at
/// all places.
void weigh_strips(std::span<const Place> places, const LaneConfig& config, Hypothesis& hypothesis) {
  if (may_be_shoulder(places.front().cut, places.front().candidate))
    for (const Place& place : places)
      hypothesis.shoulder_log_odds.push_back(shoulder_log_odds(place.cut, place.candidate, config));
  const auto may_be_cycle_lane = [&](const Place& place) {
    return lanes::may_be_cycle_lane(place.cut, place.candidate, config);
  };
  if (std::ranges::any_of(places, may_be_cycle_lane))
    for (const Place& place : places)
      hypothesis.cycle_log_odds.push_back(cycle_log_odds(place.cut, place.candidate, config));
}

/// Gives hypotheses their log odds.
std::vector<Hypothesis> weighed(std::vector<Hypothesis> found, const RoadCuts& cuts,
                                const boundaries::SectionGraph& road, Poses driven,
                                const LaneConfig& config) {
  if (found.empty()) return found;
  const MeasuredPolyline& base = road.boundaries[found.front().base].course;
  const double step_m = base.length() / static_cast<double>(std::max<std::size_t>(cuts.size() - 1, 1));
  std::vector<VehicleBeside> vehicles;
  for (const Eigen::Isometry3d& pose : driven) vehicles.emplace_back(base, found.front().reversed, pose);
  std::vector<Place> places;
  places.reserve(cuts.size());
  std::vector<PlaceBetween> between;
  between.reserve(cuts.size());
  std::vector<double> parted;
  for (Hypothesis& one : found) {
    list_places(one, cuts, places);
    const bool is_driven = std::ranges::any_of(vehicles, [&](const VehicleBeside& vehicle) {
      return drives_in(vehicle, one, places, road, config);
    });
    // Two lanes fit into no gore.
    const GorePlaces gore = one.room == Room::divided ? GorePlaces() : gore_places(places, between);
    parted.assign(cuts.size(), 0.0);
    if (one.room == Room::between) find_parted(one.other, cuts, step_m, parted);
    one.log_odds.reserve(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const RoadCut& cut = places[i].cut;
      Candidate& candidate = places[i].candidate;
      candidate.driven = is_driven;
      candidate.room_driven = drives_in_room(vehicles, one.room, places[i].width_m);
      candidate.here = is_driven && is_near(vehicles, cut.self().point);
      candidate.gore = gore.contains(i);
      candidate.parted = parted[one.first + i];
      candidate.taper = is_open(one.room) ? 0.0 : taper_at(places, i, step_m);
      const bool outer = !is_open(one.room) && is_parted(cut, candidate.left, 0.0);
      one.log_odds.push_back(std::clamp(log_odds(cut, candidate, config), kLeastPlace, kMostPlace) +
                             (outer ? kOuterOfTwo : 0.0));
    }
    if (config.find_side_strips) weigh_strips(places, config, one);
  }
  return found;
}

}  // namespace

std::vector<Hypothesis> hypotheses(std::size_t boundary, const RoadCuts& cuts,
                                   const boundaries::SectionGraph& road, Poses driven,
                                   const LaneConfig& config) {
  Collection collection(boundary, false, cuts.size());
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const RoadCut cut = cuts[c];
    add_on_left(cut, c, config, collection, [&](const Mark& mark) {
      return !mark.opposed || mark.boundary > boundary || is_other_side(cut, mark);
    });
    for (const Room room : {Room::open_left, Room::open_right})
      if (config.one_sided_lanes &&
          width_m(cut, {.room = room, .left = cut.own, .right = cut.own}) > kMinRoom_m)
        collection.add(c, room, boundary, cut.own);
  }
  return weighed(collection.take(), cuts, road, driven, config);
}

std::vector<Hypothesis> hypotheses_against(std::size_t boundary, const RoadCuts& cuts,
                                           const boundaries::SectionGraph& road, Poses driven,
                                           const LaneConfig& config) {
  Collection collection(boundary, true, cuts.size());
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const RoadCut cut = cuts[c];
    add_on_left(cut, c, config, collection, [&](const Mark& mark) {
      return (!mark.opposed && mark.boundary > boundary) || is_other_side(cut, mark);
    });
  }
  return weighed(collection.take(), cuts, road, driven, config);
}

std::vector<Run> best_runs(const std::vector<double>& log_odds) {
  // The best sums up to a place, outside of a run and within one (Viterbi).
  double outside = 0.0, within = -kBegin;
  struct Step {
    bool begins, ends;
  };
  std::vector<Step> best(log_odds.size());  // the best way there
  for (std::size_t i = 0; i < log_odds.size(); ++i) {
    best[i] = {.begins = i == 0 || outside - kBegin > within, .ends = i > 0 && within > outside};
    const double up_to_here = best[i].begins ? outside - kBegin : within;
    outside = best[i].ends ? within : outside;
    within = up_to_here + log_odds[i];
  }
  std::vector<Run> runs;
  bool inside = within > outside;
  for (std::size_t i = log_odds.size(), end = i; i-- > 0;) {
    if (!inside) {
      inside = best[i].ends;
      end = i;
    } else if (best[i].begins) {
      runs.push_back({.begin = i, .end = end, .log_odds = -kBegin});
      inside = false;
    }
  }
  std::ranges::reverse(runs);
  for (Run& run : runs)
    for (std::size_t i = run.begin; i < run.end; ++i) run.log_odds += log_odds[i];
  return runs;
}

}  // namespace laneloom::lanes
