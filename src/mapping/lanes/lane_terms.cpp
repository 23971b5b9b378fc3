#include "mapping/lanes/lane_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace laneloom::lanes {
namespace {

/// A vertex of a curve of log odds over a distance.
struct Knot {
  double at_m, log_odds;
};

// Width of a lane.
constexpr std::array kBetweenLines{Knot{1.2, -3.0}, Knot{2.1, -0.8}, Knot{2.8, 2.2}, Knot{3.5, 4.9},
                                   Knot{4.5, 2.2},  Knot{6.0, 0.0},  Knot{6.6, -2.8}};
constexpr std::array kBesideEdge{Knot{1.2, -1.6}, Knot{2.1, -0.9}, Knot{2.8, 1.9}, Knot{3.5, 4.0},
                                 Knot{5.0, 1.6},  Knot{6.0, 1.0},  Knot{7.0, -2.5}};
constexpr std::array kBetweenEdges{Knot{2.0, -2.2}, Knot{2.7, -0.9}, Knot{3.5, 1.8},
                                   Knot{4.5, -0.4}, Knot{5.5, 0.5},  Knot{6.5, -3.8}};
// Likewise, between the edge of a round island and another one: there lies one lane, up to a width.
constexpr std::array kRoundIsland{Knot{2.5, -2.0}, Knot{3.5, 1.5}};
constexpr double kMostRound_m = 8.0;
constexpr double kNotDivided = -6.0;
// Width of each of two lanes.
constexpr std::array kDivided{Knot{2.0, -5.7}, Knot{2.7, -4.8}, Knot{3.2, 0.1},
                              Knot{3.7, 1.0},  Knot{4.5, -0.3}, Knot{6.0, -1.2}};
// Room beside a mark, up to the next one.
constexpr std::array kOpen{Knot{5.0, -2.9}, Knot{6.0, 0.0}, Knot{7.5, 3.5}, Knot{10.0, -2.3},
                           Knot{14.0, -0.4}};
// The kinds of marks.
constexpr double kDividedLines = -0.36;
constexpr double kDividedMixed = -0.07;
constexpr double kOpenEdge = -1.90;
// Each of these counts per unit of a quantity.
constexpr double kSurer = 0.10;        // log odds of the less sure mark
constexpr double kLineInside = -0.37;  // log odds of a line within the lane, plus 2
constexpr double kEdgeInside = -0.54;  // likewise of an edge
constexpr double kDashed = 0.23;       // dashed share of both lines
constexpr double kBothSolid = -1.40;   // product of their solid shares: a median
constexpr double kShoulder = -4.45;    // metres below max_shoulder_width_m, across a solid line from a lane
constexpr double kNothingBeyond = -1.14;  // beside an edge: nothing lies across the line
constexpr double kEdgeAlong = 1.00;       // lines that are painted along an edge
constexpr double kVerge = -1.60;          // lines across one of two edges: a road lies there
constexpr double kDriven = 0.91;          // the vehicle drives in the lane
constexpr double kDrivenEdges = 1.65;     // likewise, between two edges
constexpr double kDrivenAcross = -0.30;   // likewise, but a mark lies within the lane
constexpr double kLeastDriven = 0.0;      // likewise: at least, of the likelier of one lane and two
constexpr double kLeastDrivenLine = 0.5;  // likewise, beside a line
constexpr double kTaper = -10.00;         // change of the width, per metre
constexpr double kGore = -6.00;           // its borders meet, and neither may be crossed from there to here
constexpr double kMedian = -6.00;         // edges lie along the borders, within
constexpr double kUnseenLine = -6.00;  // a line parts the marks not far along the road, which goes on unseen
constexpr double kBend = -7.82;        // curvature, 1/m
constexpr double kBendOpen = -18.67;   // likewise, where the other border is unseen
constexpr double kStreetLanes = 2.00;  // the SD map tells as many lanes, or (negative) another number
constexpr double kDrivenOpen = 2.40;   // the vehicle drives in the lane, whose other border is unseen
constexpr double kDashedOpen = 1.31;   // dashed share of the line
constexpr double kAlongEdgeOpen = -1.58;  // an edge lies along the line, on its other side
constexpr double kEdgeOfLanes = -1.51;    // lines near an edge, which rather has its lane on their side

// The default limits of widths, with which the curves were fitted, and the widths of usual lanes.
constexpr double kLeastWidth_m = 2.3, kMaxWidth_m = 4.5, kMaxKerbWidth_m = 6.5, kDividedFrom_m = 6.5;
constexpr double kUsualFrom_m = 2.8, kUsualTo_m = 3.5;
constexpr double kLeastSpan_m = 0.1;
constexpr double kLeastEach_m = 2.2, kMostEach_m = 6.5;  // of a street's lanes, as the SD map counts them

// Width of a shoulder, its line, and what lies across that.
constexpr std::array kShoulderWidth{Knot{0.6, -2.0}, Knot{1.0, 1.0}, Knot{1.5, 2.0}};
constexpr double kWiderShoulder = -10.0;  // per metre more than this below max_shoulder_width_m:
constexpr double kUsualShoulder_m = 0.6;
constexpr double kNoSolidLine = -3.0;     // without a style, every second one of such strips was a lane
constexpr double kSolidLine = 4.5;        // solid share of the line
constexpr double kBesideLane = 0.5;       // the next line lies across that line
constexpr double kBesideNoLane = -6.0;    // an edge, as across the line in the middle of a road, or nothing
constexpr double kDrivenShoulder = -8.0;  // the vehicle drives there

// Width of a cycle lane, and what lies beside it, across a line.
constexpr std::array kCycleWidth{Knot{1.0, -4.0}, Knot{1.2, 1.0}, Knot{1.5, 2.0},
                                 Knot{2.1, 2.0},  Knot{2.4, 0.0}, Knot{2.6, -4.0}};
constexpr double kBesideStrip_m = 1.2;  // to the next mark: a lane, or another cycle lane
constexpr double kAlone = -6.0;         // no such mark, as beside a line that is seen double
constexpr double kUnsureMark = 0.5;     // log odds of the less sure mark, below those of a confirmed one
constexpr double kSureMark = 2.0;

constexpr double kAlongEdge_m = 1.2;                // distance of a line that is painted along an edge
constexpr double kLeastWithin_m = 0.15;             // of an edge from a border
constexpr double kLane_m = 2.2, kWideLane_m = 5.0;  // widths that rather are a lane's
constexpr double kWide_m = 4.0, kWider_m = 1.0;     // a lane's width, and how much more is two lanes' rather
constexpr double kMostDriven_m = 7.0;               // width of one lane or two that the vehicle drives in
constexpr double kNothing_m = 11.0;                 // room in which nothing lies
constexpr double kNear_m = 8.0;                     // distance of lines that belong to the same road
constexpr double kMostNarrow_m = 1.5;
constexpr double kMostTaper = 0.3;
constexpr double kMostBend = 0.2;
constexpr double kLeastLogOdds = -3.0, kMostLogOdds = 5.0;
constexpr double kMostInside = 5.0, kInsidePrior = 2.0;
constexpr double kMostLines = 2.0;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

double on_curve(std::span<const Knot> curve, double at_m) {
  if (at_m <= curve.front().at_m) return curve.front().log_odds;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Knot &from = curve[i - 1], &to = curve[i];
    if (at_m > to.at_m) continue;
    return from.log_odds + (at_m - from.at_m) / (to.at_m - from.at_m) * (to.log_odds - from.log_odds);
  }
  return curve.back().log_odds;
}

/// From 0 for a usual lane's width to 1 for one that rather is a lane's and more.
double wide(double width_m) { return std::clamp((width_m - kWide_m) / kWider_m, 0.0, 1.0); }
double bounded(double log_odds) { return std::clamp(log_odds, kLeastLogOdds, kMostLogOdds); }
double solid(const Mark& line) { return std::max(-line.dashed, 0.0); }
double dashed(const Mark& line) { return std::max(line.dashed, 0.0); }

/// A cross-section, seen from a candidate.
class Surroundings {
 public:
  Surroundings(const RoadCut& cut, const Candidate& candidate)
      : marks_(cut.marks), left_(candidate.left), right_(candidate.right) {}

  const Mark& left() const { return marks_[left_]; }
  const Mark& right() const { return marks_[right_]; }
  const Mark& border(Side side) const { return side == Side::left ? left() : right(); }
  /// The next mark beyond a border. Null: there is none.
  const Mark* beyond(Side side) const {
    if (side == Side::left) return left_ + 1 < marks_.size() ? &marks_[left_ + 1] : nullptr;
    return right_ > 0 ? &marks_[right_ - 1] : nullptr;
  }
  double gap_beyond_m(Side side) const {
    const Mark* next = beyond(side);
    if (next == nullptr) return kCutReach_m;
    return std::abs(next->lateral_m - border(side).lateral_m);
  }
  bool edge_along(Side side) const {
    const Mark* next = beyond(side);
    return next != nullptr && next->is_edge && gap_beyond_m(side) < kAlongEdge_m;
  }
  /// Whether an edge lies along a border within the lane. The border is that edge's line, then.
  bool edge_within(Side side) const {
    if (right_ + 1 >= left_) return false;
    const Mark& next = marks_[side == Side::left ? left_ - 1 : right_ + 1];
    const double aside_m = std::abs(next.lateral_m - border(side).lateral_m);
    return next.is_edge && next.log_odds > 0.0 && aside_m > kLeastWithin_m && aside_m < kAlongEdge_m;
  }
  /// What the marks within the lane say that they exist, of one kind.
  double inside(bool edges) const {
    double sum = 0.0;
    for (std::size_t i = right_ + 1; i < left_; ++i) {
      const Mark& mark = marks_[i];
      const double aside_m = std::min(left().lateral_m - mark.lateral_m, mark.lateral_m - right().lateral_m);
      if (mark.is_edge == edges && aside_m >= kBesideBorder_m)
        sum += std::max(mark.log_odds + kInsidePrior, 0.0);
    }
    return std::min(sum, kMostInside);
  }
  /// The number of lines of the road outside of the lane.
  double lines_outside() const {
    double count = 0.0;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      if (i >= right_ && i <= left_) continue;
      const double out_m =
          i > left_ ? marks_[i].lateral_m - left().lateral_m : right().lateral_m - marks_[i].lateral_m;
      if (!marks_[i].is_edge && marks_[i].log_odds > 0.0 && out_m < kNear_m) count += 1.0;
    }
    return std::min(count, kMostLines);
  }

 private:
  std::span<const Mark> marks_;
  std::size_t left_, right_;
};

/// The log odds of a bend. The corner of two streets looks like one, but no vehicle drives round that.
double of_bend(double weight, const RoadCut& cut, const Candidate& candidate) {
  return candidate.here ? 0.0 : weight * std::min(cut.bend, kMostBend);
}

double of_open_lane(const RoadCut& cut, double room_m, const Candidate& candidate) {
  const Surroundings around(cut, candidate);
  const Mark& mark = around.left();
  const Side other = candidate.room == Room::open_left ? Side::right : Side::left;
  double sum = on_curve(kOpen, room_m) + kSurer * bounded(mark.log_odds) + of_bend(kBendOpen, cut, candidate);
  if (candidate.driven)
    sum += kDrivenOpen;
  else if (candidate.gore)
    sum += kGore;
  if (around.edge_along(other)) sum += kAlongEdgeOpen;
  if (!mark.is_edge) return sum + kDashedOpen * dashed(mark);
  return sum + kOpenEdge + kEdgeOfLanes * around.lines_outside();
}

/// A width as it counts on a curve, which was fitted with the default limits. A width is as far above a
/// configured lower limit as it counts above the default one, up to usual widths; what lies between a usual
/// width and a configured upper limit is stretched to what lies between it and the default limit.
double as_by_default(double width_m, double least_m, double most_m, double default_most_m) {
  if (width_m > kUsualTo_m)
    return kUsualTo_m + (width_m - kUsualTo_m) * (default_most_m - kUsualTo_m) /
                            std::max(most_m - kUsualTo_m, kLeastSpan_m);
  const double usual_from_m = std::min(least_m + kUsualFrom_m - kLeastWidth_m, kUsualTo_m - kLeastSpan_m);
  if (width_m < usual_from_m) return kUsualFrom_m - (usual_from_m - width_m);
  const double from_m = std::max(usual_from_m, kUsualFrom_m);
  return kUsualFrom_m + std::max(width_m - from_m, 0.0) * (kUsualTo_m - kUsualFrom_m) / (kUsualTo_m - from_m);
}

bool is_between_edges(const Surroundings& around) { return around.left().is_edge && around.right().is_edge; }

/// Whether one of two edges bounds a round island on its other side. Traffic goes round that in one lane.
bool is_round_island(const Surroundings& around, double width_m) {
  return is_between_edges(around) && width_m < kMostRound_m &&
         (around.left().island == Side::left || around.right().island == Side::right);
}

/// What the width says, and the kinds of the marks.
double of_width(const Surroundings& around, double width_m, Room room, const LaneConfig& config) {
  if (is_round_island(around, width_m))
    return room == Room::divided ? kNotDivided : on_curve(kRoundIsland, width_m);
  const int edges = (around.left().is_edge ? 1 : 0) + (around.right().is_edge ? 1 : 0);
  if (room == Room::divided)
    return on_curve(kDivided, 0.5 * (width_m - config.min_divided_width_m + kDividedFrom_m)) +
           (edges == 0   ? kDividedLines
            : edges == 1 ? kDividedMixed
                         : 0.0);
  const double least_m = config.min_width_m;
  if (edges == 0)
    return on_curve(kBetweenLines, as_by_default(width_m, least_m, config.max_width_m, kMaxWidth_m));
  if (edges == 1)
    return on_curve(kBesideEdge, as_by_default(width_m, least_m, config.max_kerb_width_m, kMaxKerbWidth_m));
  return on_curve(kBetweenEdges, as_by_default(width_m, least_m, config.min_divided_width_m, kDividedFrom_m));
}

/// Whether a mark that rather is there than not lies within the lane.
bool has_mark_within(const Surroundings& around) {
  return around.inside(true) > kInsidePrior || around.inside(false) > kInsidePrior;
}

/// Whether the strip lies between the two edges of a median, one or both of which have a line along them.
bool is_median(const Surroundings& around) {
  const bool on_left = around.edge_within(Side::left), on_right = around.edge_within(Side::right);
  return (on_left && on_right) || (on_left && around.right().is_edge) || (on_right && around.left().is_edge);
}

/// What it says that the vehicle drives there.
double of_driving(const Surroundings& around) {
  if (has_mark_within(around)) return kDrivenAcross;
  return is_between_edges(around) ? kDrivenEdges : kDriven;
}

/// What the lines say that lie beside an edge.
double of_shoulder(const Surroundings& around, double width_m, Room room, const LaneConfig& config) {
  const Side side = around.left().is_edge ? Side::right : Side::left;
  const Mark& line = around.border(side);
  const double gap_m = around.gap_beyond_m(side);
  double sum = gap_m > kNothing_m ? kNothingBeyond : 0.0;
  if (config.find_side_strips && room == Room::between && gap_m > kLane_m && gap_m < kWideLane_m)
    sum += kShoulder * 0.5 * (1.0 - line.dashed) *
           std::clamp(config.max_shoulder_width_m - width_m, 0.0, kMostNarrow_m);
  return sum;
}

/// The log odds by the SD map's number of lanes, where the street is seen from edge to edge.
double of_street(const RoadCut& cut, const Candidate& candidate) {
  if (cut.street_lanes == 0) return 0.0;
  const auto is_edge = [](const Mark& mark) { return mark.is_edge && mark.log_odds > 0.0; };
  const auto from_left = cut.marks.subspan(candidate.left);
  const auto up_to_right = cut.marks.first(candidate.right + 1);
  const auto left = std::ranges::find_if(from_left, is_edge);
  const auto right = std::find_if(up_to_right.rbegin(), up_to_right.rend(), is_edge);
  if (left == from_left.end() || right == up_to_right.rend()) return 0.0;
  const double each_m = (left->lateral_m - right->lateral_m) / cut.street_lanes;
  if (each_m < kLeastEach_m || each_m > kMostEach_m) return 0.0;
  const double lanes = candidate.room == Room::divided ? 2.0 : 1.0;
  return std::round(width_m(cut, candidate) / each_m) == lanes ? kStreetLanes : -kStreetLanes;
}

/// The log odds of lanes between two marks.
double of_lane(const RoadCut& cut, const Candidate& candidate, const LaneConfig& config) {
  const Surroundings around(cut, candidate);
  const double wide_m = width_m(cut, candidate);
  const Mark &left = around.left(), &right = around.right();
  double sum = of_width(around, wide_m, candidate.room, config);
  if (!is_round_island(around, wide_m)) sum += of_bend(kBend, cut, candidate);
  sum += kSurer * bounded(std::min(left.log_odds, right.log_odds)) + kEdgeInside * around.inside(true);
  sum += kTaper * std::min(candidate.taper, kMostTaper);
  if (candidate.driven)
    sum += of_driving(around);
  else if (candidate.gore)
    sum += kGore;
  for (const Side side : kSides)
    if (!around.border(side).is_edge && around.edge_along(side)) sum += kEdgeAlong;
  if (is_median(around)) sum += kMedian;
  sum += of_street(cut, candidate);
  if (candidate.room == Room::between) {
    sum += kUnseenLine * candidate.parted * wide(wide_m) + kLineInside * around.inside(false) +
           kDashed * (dashed(left) + dashed(right)) + kBothSolid * solid(left) * solid(right);
  }
  if (is_between_edges(around)) return candidate.driven ? sum : sum + kVerge * around.lines_outside();
  return left.is_edge || right.is_edge ? sum + of_shoulder(around, wide_m, candidate.room, config) : sum;
}

/// The log odds of a cycle lane by its width. It is narrower than a lane.
double of_cycle_width(double width_m, const LaneConfig& config) {
  return on_curve(kCycleWidth, width_m + kLeastWidth_m - config.min_width_m);
}

/// The log odds that lanes lie between the mark of an open lane and the next one on that side.
double of_lanes_instead(const RoadCut& cut, const Candidate& open, const LaneConfig& config) {
  Candidate instead = open;
  instead.driven = open.room_driven;
  if (open.room == Room::open_left) {
    if (++instead.left == cut.marks.size()) return -kNoLimit;
  } else {
    if (instead.right-- == 0) return -kNoLimit;
  }
  double most = -kNoLimit;
  for (const Room room : {Room::between, Room::divided}) {
    instead.room = room;
    most = std::max(most, log_odds(cut, instead, config));
  }
  return most;
}

}  // namespace

double width_m(const RoadCut& cut, const Candidate& candidate) {
  if (!is_open(candidate.room))
    return cut.marks[candidate.left].lateral_m - cut.marks[candidate.right].lateral_m;
  return Surroundings(cut, candidate)
      .gap_beyond_m(candidate.room == Room::open_left ? Side::left : Side::right);
}

bool is_kerb(const RoadCut& cut, std::size_t mark, Side side) {
  return cut.marks[mark].is_edge || Surroundings(cut, {.left = mark, .right = mark}).edge_along(side);
}

double log_odds(const RoadCut& cut, const Candidate& candidate, const LaneConfig& config) {
  if (is_open(candidate.room))
    return std::min(of_open_lane(cut, width_m(cut, candidate), candidate),
                    -of_lanes_instead(cut, candidate, config));
  const double sum = of_lane(cut, candidate, config);
  const Surroundings around(cut, candidate);
  const double wide_m = width_m(cut, candidate);
  if (!candidate.driven || wide_m < config.min_width_m || wide_m > kMostDriven_m || has_mark_within(around))
    return sum;
  Candidate instead = candidate;
  instead.room = candidate.room == Room::between ? Room::divided : Room::between;
  const double least = is_between_edges(around) ? kLeastDriven : kLeastDrivenLine;
  return sum + std::max(least - std::max(sum, of_lane(cut, instead, config)), 0.0);
}

bool may_be_shoulder(const RoadCut& cut, const Candidate& candidate) {
  return candidate.room == Room::between &&
         cut.marks[candidate.left].is_edge != cut.marks[candidate.right].is_edge;
}

double shoulder_log_odds(const RoadCut& cut, const Candidate& candidate, const LaneConfig& config) {
  const Surroundings around(cut, candidate);
  const Side line = around.left().is_edge ? Side::right : Side::left;
  const Mark* next = around.beyond(line);
  const double gap_m = around.gap_beyond_m(line), wide_m = width_m(cut, candidate);
  const bool is_beside_lane = next != nullptr && !next->is_edge && gap_m > kLane_m && gap_m < kNothing_m;
  return on_curve(kShoulderWidth, wide_m) +
         kWiderShoulder * std::max(wide_m + kUsualShoulder_m - config.max_shoulder_width_m, 0.0) +
         kNoSolidLine + kSolidLine * solid(around.border(line)) +
         (is_beside_lane ? kBesideLane : kBesideNoLane) + (candidate.driven ? kDrivenShoulder : 0.0) +
         kSurer * bounded(std::min(around.left().log_odds, around.right().log_odds)) +
         kEdgeInside * around.inside(true) + kLineInside * around.inside(false);
}

bool may_be_cycle_lane(const RoadCut& cut, const Candidate& candidate, const LaneConfig& config) {
  return candidate.room == Room::between &&
         !(cut.marks[candidate.left].is_edge && cut.marks[candidate.right].is_edge) &&
         of_cycle_width(width_m(cut, candidate), config) > 0.0;
}

double cycle_log_odds(const RoadCut& cut, const Candidate& candidate, const LaneConfig& config) {
  const Surroundings around(cut, candidate);
  const bool is_beside_strip = std::ranges::any_of(kSides, [&](Side side) {
    const double gap_m = around.gap_beyond_m(side);
    return !around.border(side).is_edge && gap_m > kBesideStrip_m && gap_m < kNothing_m;
  });
  const double less_sure = bounded(std::min(around.left().log_odds, around.right().log_odds));
  return of_cycle_width(width_m(cut, candidate), config) + (is_beside_strip ? 0.0 : kAlone) +
         kUnsureMark * std::min(less_sure - kSureMark, 0.0) + (candidate.driven ? kDrivenShoulder : 0.0) +
         kEdgeInside * around.inside(true) + kLineInside * around.inside(false);
}

}  // namespace laneloom::lanes
