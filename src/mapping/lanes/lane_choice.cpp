#include "mapping/lanes/lane_choice.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "mapping/geometry/left_of.hpp"
#include "mapping/geometry/stretches.hpp"
#include "mapping/lanes/driven_lane.hpp"
#include "mapping/lanes/hypotheses.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kKnown =
    1.0;  // log odds of a place where the last map had a lane between the same boundaries
constexpr double kWereTwo = 2.0;  // that a place has one wide lane where the last map had two
constexpr double kWide_m = 5.0;
constexpr double kLeastDoubted = -2.0;  // with less, a place has no lane, whatever the last map had
constexpr double kNever = -1e6;         // log odds of a place that another lane has
constexpr double kMinAdvance = 0.3;     // share of the step; less is the inside of a bend that is too tight
constexpr double kSpared = 0.75;        // share of a lane's width up to where there must be no other lane

/// Takes hypotheses, the surest first, as far as nothing that was taken lies there.
class Choice {
 public:
  Choice(const boundaries::SectionGraph& road, const geometry::MapBox& box, const Driven& driven,
         const KnownRoad& known, const LaneConfig& config)
      : road_(road),
        box_(box),
        way_(driven.way),
        known_(known.borders),
        config_(config),
        section_of_(road.boundaries.size()) {
    for (std::uint32_t s = 0; s < road.sections.size(); ++s)
      for (const std::size_t i : road.sections[s].boundaries) section_of_[i] = s;
    for (std::size_t i = 0; i < road.boundaries.size(); ++i) {
      cuts_.push_back(cut_along(i, road, config));
      if (known.sd_map != nullptr) cuts_.back().look_up(*known.sd_map);
      for (Hypothesis& one : hypotheses(i, cuts_.back(), road, driven.poses, config))
        consider(std::move(one));
      against_.push_back(cuts_.back().has_opposed() ? cuts_.back().reversed() : RoadCuts());
      for (Hypothesis& one : hypotheses_against(i, against_.back(), road, driven.poses, config))
        consider(std::move(one));
    }
  }

  void choose() {
    std::ranges::stable_sort(waiting_, std::greater{}, &Waiting::log_odds);
    for (const Waiting& one : waiting_) take(one);
  }

  FoundLanes result() && {
    return {.boundaries = {},
            .lanes = std::move(lanes_),
            .inferred = std::move(inferred_),
            .denied = std::move(denied_),
            .side_strips = std::move(side_strips_)};
  }

 private:
  struct Waiting {
    Hypothesis hypothesis;
    Lane::Use use = Lane::Use::lane;
    double log_odds = 0.0;  ///< of its best run
  };

  void consider(Hypothesis hypothesis) {
    const ElementId left_id = left(hypothesis).marking.id, right_id = right(hypothesis).marking.id;
    if (hypothesis.room == Room::between &&
        (known_.contains({left_id, right_id}) || known_.contains({right_id, left_id})))
      deny(hypothesis);
    if (known_.contains({left_id, right_id}))
      for (double& log_odds : hypothesis.log_odds) log_odds += kKnown;
    if (!is_open(hypothesis.room) && were_two_between(hypothesis)) remember_two(hypothesis);
    std::vector<double> of_shoulder = std::exchange(hypothesis.shoulder_log_odds, {});
    std::vector<double> of_cycle_lane = std::exchange(hypothesis.cycle_log_odds, {});
    await_strip(hypothesis, Lane::Use::shoulder, std::move(of_shoulder));
    await_strip(hypothesis, Lane::Use::cycle, std::move(of_cycle_lane));
    await({.hypothesis = std::move(hypothesis)});
  }

  /// Awaits that no lane lies there, but a strip of another use. Most have no place where that is likely.
  void await_strip(const Hypothesis& hypothesis, Lane::Use use, std::vector<double> log_odds) {
    if (std::ranges::none_of(log_odds, [](double one) { return one > 0.0; })) return;
    Hypothesis strip = hypothesis;
    strip.log_odds = std::move(log_odds);
    await({.hypothesis = std::move(strip), .use = use});
  }

  void await(Waiting one) {
    for (const Run& run : best_runs(one.hypothesis.log_odds))
      one.log_odds = std::max(one.log_odds, run.log_odds);
    if (one.log_odds > 0.0) waiting_.push_back(std::move(one));
  }

  /// Weighs a strip in which the last map had two lanes, where nothing is seen between its borders now.
  void remember_two(Hypothesis& one) const {
    for (std::size_t i = 0; i < one.log_odds.size(); ++i) {
      const RoadCut cut = cut_of(one, i);
      if (one.marks[i] != cut.own + 1) continue;
      if (one.room == Room::divided)
        one.log_odds[i] += kKnown;
      else if (cut.marks[one.marks[i]].lateral_m > kWide_m)
        one.log_odds[i] -= kWereTwo;
    }
  }

  /// Whether the last map had two lanes side by side between the boundaries of a hypothesis. A street between
  /// two edges may narrow to one lane: there, its width tells.
  bool were_two_between(const Hypothesis& one) const {
    if (left(one).is_edge() && right(one).is_edge()) return false;
    const ElementId left_id = left(one).marking.id, right_id = right(one).marking.id;
    for (auto known = known_.lower_bound({left_id, kNoElement});
         known != known_.end() && known->front() == left_id; ++known) {
      const boundaries::LaneBoundary* divider = road_.boundaries.find(known->back());
      if (known->back() == kNoElement || (divider != nullptr && divider->is_edge())) continue;
      if (known_.contains({known->back(), right_id})) return true;
    }
    return false;
  }

  /// Notes where a known lane is denied.
  void deny(const Hypothesis& one) {
    Polyline middle;
    for (std::size_t i = 0; i <= one.log_odds.size(); ++i) {
      if (i < one.log_odds.size() && one.log_odds[i] < kLeastDoubted) {
        const RoadCut cut = cut_of(one, i);
        middle.push_back(0.5 * (cut.self().point + cut.marks[one.marks[i]].point));
      } else {
        if (middle.size() > 1)
          denied_.push_back({{left(one).marking.id, right(one).marking.id}, std::move(middle)});
        middle.clear();
      }
    }
  }

  void take(const Waiting& waiting) {
    const Hypothesis& one = waiting.hypothesis;
    std::vector<double> free = one.log_odds;
    const std::vector<CrossSection> sections = sections_of(one);
    for (std::size_t i = 0; i < free.size(); ++i)
      if (!sections[i].valid || is_taken(one, sections[i])) free[i] = kNever;
    for (const Run& run : best_runs(free)) {
      if (run.log_odds <= 0.0) continue;
      const std::span part(sections.begin() + static_cast<std::ptrdiff_t>(run.begin), run.size());
      if (length_of(part) < config_.min_length_m) continue;
      if (one.room == Room::between) add_lane(one, part, waiting.use);
      if (one.room == Room::divided) add_divided(one, part);
      if (is_open(one.room)) add_open(one, part);
    }
  }

  const boundaries::LaneBoundary& left(const Hypothesis& one) const { return road_.boundaries[one.other]; }
  const boundaries::LaneBoundary& right(const Hypothesis& one) const { return road_.boundaries[one.base]; }
  RoadCut cut_of(const Hypothesis& one, std::size_t i) const {
    return (one.reversed ? against_ : cuts_)[one.base][one.first + i];
  }
  /// Whether the border on the left runs against the hypothesis.
  bool is_opposed(const Hypothesis& one) const {
    if (is_open(one.room)) return one.reversed;
    return cut_of(one, 0).marks[one.marks.front()].opposed;
  }
  LaneBorder left_border(const Hypothesis& one) const { return {left(one), is_opposed(one)}; }
  LaneBorder right_border(const Hypothesis& one) const { return {right(one), one.reversed}; }

  /// Whether the border is an edge, or a line that is painted along one, where the hypothesis begins.
  bool is_kerb(const Hypothesis& one, Side border) const {
    const RoadCut cut = cut_of(one, 0);
    return lanes::is_kerb(cut, border == Side::left ? one.marks.front() : cut.own, border);
  }

  std::vector<CrossSection> sections_of(const Hypothesis& one) const {
    std::vector<CrossSection> sections;
    const double left_m = left(one).course.length(), right_m = right(one).course.length();
    const bool opposed = is_opposed(one);
    sections.reserve(one.marks.size());
    for (std::size_t i = 0; i < one.marks.size(); ++i) {
      const RoadCut cut = cut_of(one, i);
      const Mark &self = cut.self(), &other = cut.marks[one.marks[i]];
      CrossSection section{.left_arc_m = opposed ? left_m - other.arc_m : other.arc_m,
                           .right_arc_m = one.reversed ? right_m - self.arc_m : self.arc_m,
                           .width_m = other.lateral_m,
                           .left = other.point,
                           .right = self.point,
                           .valid = true};
      if (is_open(one.room)) {
        const bool is_left = one.room == Room::open_left;
        section.width_m = config_.assumed_width_m;
        const Point border =
            geometry::beside(self.point, cut.ahead, (is_left ? 1.0 : -1.0) * section.width_m);
        (is_left ? section.left : section.right) = border;
        section.valid = box_.shows(border);
      }
      if (!sections.empty()) {
        const CrossSection& before = sections.back();
        const auto advance = [&](const Point& from, const Point& to) {
          return (to - from).head<2>().dot(cut.ahead);
        };
        const double least_m = is_open(one.room) ? kMinAdvance * config_.step_m : 0.0;
        section.valid = section.valid && advance(before.left, section.left) > least_m &&
                        advance(before.right, section.right) > least_m;
      }
      sections.push_back(section);
    }
    return sections;
  }

  /// The side of the boundary `of` a hypothesis on which its lane lies, as the boundary runs.
  BoundarySide inner(const Hypothesis& one, Side border) const {
    if (border == Side::right)
      return {right(one).marking.id,
              as_seen(one.room == Room::open_right ? Side::right : Side::left, one.reversed)};
    return {left(one).marking.id, as_seen(Side::right, is_opposed(one))};
  }

  bool is_taken(const Hypothesis& one, const CrossSection& section) {
    const auto on_side = [&](Side side, double arc_m) {
      return geometry::contains(taken_.beside(inner(one, side)), arc_m);
    };
    const auto own = [](const boundaries::LaneBoundary& border, bool reversed, double arc_m) {
      return reversed ? border.course.length() - arc_m : arc_m;
    };
    if (on_side(Side::right, own(right(one), one.reversed, section.right_arc_m))) return true;
    if (!is_open(one.room) && on_side(Side::left, own(left(one), is_opposed(one), section.left_arc_m)))
      return true;
    const auto at = [&](double share) -> Point {
      return section.right + share * (section.left - section.right);
    };
    return taken_.contains(at(0.5)) || (one.room != Room::open_right && taken_.contains(at(kSpared))) ||
           (one.room != Room::open_left && taken_.contains(at(1.0 - kSpared)));
  }

  void occupy(const Hypothesis& one, std::span<const CrossSection> part) {
    taken_.beside(inner(one, Side::right))
        .push_back(right_border(one).own({part.front().right_arc_m, part.back().right_arc_m}));
    if (!is_open(one.room))
      taken_.beside(inner(one, Side::left))
          .push_back(left_border(one).own({part.front().left_arc_m, part.back().left_arc_m}));
    Polyline middle;
    middle.reserve(part.size());
    double width_m = 0.0;
    for (const CrossSection& section : part) {
      middle.push_back(section.middle());
      width_m += section.width_m / static_cast<double>(part.size());
    }
    taken_.add(middle, 0.5 * width_m);
  }

  void add_lane(const Hypothesis& one, std::span<const CrossSection> part, Lane::Use use) {
    Lane lane = make_lane(part, left_border(one), right_border(one));
    lane.use = use;
    lane.section = section_of_[one.base];
    occupy(one, part);
    (lane.is_drivable() ? lanes_ : side_strips_).push_back(std::move(lane));
  }

  void add_divided(const Hypothesis& one, std::span<const CrossSection> part) {
    InferredBoundary found{.section = section_of_[one.base]};
    found.on_left.emplace(
        InferredBoundary::Beside{.boundary = one.other, .reversed = is_opposed(one), .sections = {}});
    found.on_right.emplace(
        InferredBoundary::Beside{.boundary = one.base, .reversed = one.reversed, .sections = {}});
    Polyline divider;
    const std::optional<LaneBesideLine> driven = driven_lane(one, part);
    for (const CrossSection& section : part) {
      const double left_m = driven ? driven->left_m(section.width_m) : 0.5 * section.width_m;
      CrossSection in_left = section, in_right = section;
      in_left.right = in_right.left =
          section.left + left_m / section.width_m * (section.right - section.left);
      in_left.width_m = left_m;
      in_right.width_m = section.width_m - left_m;
      divider.push_back(in_left.right);
      found.on_left->sections.push_back(in_left);
      found.on_right->sections.push_back(in_right);
    }
    found.marking = inferred_marking(divider);
    found.two_way = is_kerb(one, Side::left) && is_kerb(one, Side::right);
    occupy(one, part);
    inferred_.push_back(std::move(found));
  }

  /// The lane beside a line in which the vehicle drives, where a kerb bounds the other side.
  std::optional<LaneBesideLine> driven_lane(const Hypothesis& one, std::span<const CrossSection> part) const {
    const bool is_left_kerb = is_kerb(one, Side::left);
    if (is_left_kerb == is_kerb(one, Side::right)) return std::nullopt;
    return driven_beside_line(way_, is_left_kerb ? Side::right : Side::left, part);
  }

  void add_open(const Hypothesis& one, std::span<const CrossSection> part) {
    const bool is_left = one.room == Room::open_left;
    Polyline border;
    for (const CrossSection& section : part) border.push_back(is_left ? section.left : section.right);
    InferredBoundary found{.marking = inferred_marking(border), .section = section_of_[one.base]};
    (is_left ? found.on_right : found.on_left)
        .emplace(InferredBoundary::Beside{.boundary = one.base, .sections = {part.begin(), part.end()}});
    occupy(one, part);
    inferred_.push_back(std::move(found));
  }

  const boundaries::SectionGraph& road_;
  const geometry::MapBox& box_;
  std::span<const Point> way_;  ///< of the vehicle
  const KnownBorders& known_;
  const LaneConfig& config_;
  std::vector<std::uint32_t> section_of_;  ///< by boundary
  std::vector<RoadCuts> cuts_;             ///< by boundary
  std::vector<RoadCuts> against_;          ///< likewise, reversed; none where no boundary runs against it
  std::vector<Waiting> waiting_;
  TakenSpace taken_;
  std::vector<Lane> lanes_;
  std::vector<InferredBoundary> inferred_;
  std::vector<DeniedStretch> denied_;
  std::vector<Lane> side_strips_;
};

}  // namespace

FoundLanes choose_lanes(const boundaries::SectionGraph& road, const geometry::MapBox& box,
                        const Driven& driven, const KnownRoad& known, const LaneConfig& config) {
  Choice choice(road, box, driven, known, config);
  choice.choose();
  return std::move(choice).result();
}

}  // namespace laneloom::lanes
