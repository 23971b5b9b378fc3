#include "simulation/cross_section.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace laneloom::simulation {
namespace {

constexpr double kDoubleLine_m = 0.24;  // between the two lines
constexpr double kGapStep_m = 1.0;
constexpr double kTiny_m = 1e-6;

// Collects the borders of one side, from the reference line outwards.
class SideBorders {
 public:
  SideBorders(const Section& section, bool right, double length_m)
      : section_(section), sign_(right ? -1.0 : 1.0), length_m_(length_m) {}

  std::vector<Border> collect(const RoadHalf& side) {
    open_lines(0, side.lanes, 0.0);
    int lanes = side.lanes;
    knots_ = {{0.0, offset_m(lanes)}};
    for (const LaneChange& change : side.changes) {
      if (change.taper_m > 0.0)
        move_edge(lanes, change);
      else
        cut_edge(lanes, change);
      open_lines(lanes, change.lanes, change.at_m);
      close_lines(lanes, change.lanes, change.at_m + change.taper_m);
      lanes = change.lanes;
    }
    close_lines(lanes, 0, length_m_);
    if (section_.shoulder_m > 0.0) {
      add(MarkingType::laneline, MarkingStyle::solid, Profile(knots_), edge_from_m_, length_m_);
      for (auto& [at_m, left_m] : knots_) left_m += sign_ * section_.shoulder_m;
    }
    add(MarkingType::roadedge, MarkingStyle::solid, Profile(knots_), edge_from_m_, length_m_);
    return std::move(borders_);
  }

 private:
  double offset_m(int lanes) const {
    return sign_ * half_width_m(lanes, section_.centre, section_.lane_width_m);
  }

  void add(MarkingType type, MarkingStyle style, const Profile& left_m, double from_m, double to_m) {
    if (to_m - from_m > kTiny_m) borders_.push_back({type, style, left_m, from_m, to_m});
  }

  void move_edge(int lanes, const LaneChange& change) {
    knots_.emplace_back(change.at_m, offset_m(lanes));
    knots_.emplace_back(change.at_m + change.taper_m, offset_m(change.lanes));
  }

  // Lets the edge jump. Beside the gore, between this street and the one that leaves or joins, it is a solid
  // line.
  void cut_edge(int lanes, const LaneChange& change) {
    const bool exit = change.lanes < lanes;
    const double gore_from_m = exit ? change.at_m : change.at_m - change.gore_m;
    add(MarkingType::roadedge, MarkingStyle::solid, Profile(knots_), edge_from_m_,
        exit ? change.at_m : gore_from_m);
    add(MarkingType::laneline, MarkingStyle::solid, offset_m(std::min(lanes, change.lanes)), gore_from_m,
        gore_from_m + change.gore_m);
    edge_from_m_ = exit ? gore_from_m + change.gore_m : change.at_m;
    knots_ = {{change.at_m, offset_m(change.lanes)}};
  }

  // The line outside of lane k begins with lane k + 1.
  void open_lines(int lanes, int more, double at_m) {
    for (int k = std::max(lanes, 1); k < more; ++k) begin_m_[k] = at_m;
  }
  void close_lines(int lanes, int fewer, double at_m) {
    for (int k = std::max(fewer, 1); k < lanes; ++k)
      add(MarkingType::laneline, k == section_.solid_after ? MarkingStyle::solid : MarkingStyle::dashed,
          offset_m(k), begin_m_[k], at_m);
  }

  const Section& section_;
  double sign_;
  double length_m_;
  std::vector<Border> borders_;
  std::vector<std::pair<double, double>> knots_;
  std::map<int, double> begin_m_;
  double edge_from_m_ = 0.0;
};

std::vector<Border> middle_borders(const Section& section, double length_m) {
  using enum MarkingType;
  using enum MarkingStyle;
  if (section.backward.lanes == 0) {
    const double edge_to_m = length_m - section.gore_end_m;
    std::vector<Border> edge{{laneline, solid, 0.0, 0.0, section.gore_begin_m},
                             {roadedge, solid, 0.0, section.gore_begin_m, edge_to_m},
                             {laneline, solid, 0.0, edge_to_m, length_m}};
    std::erase_if(edge, [](const Border& border) { return border.to_m - border.from_m < kTiny_m; });
    return edge;
  }
  if (section.centre == CentreLine::double_solid)
    return {{laneline, solid, 0.5 * kDoubleLine_m, 0.0, length_m},
            {laneline, solid, -0.5 * kDoubleLine_m, 0.0, length_m}};
  const bool painted = section.centre != CentreLine::none;
  return {{laneline, section.centre == CentreLine::dashed ? dashed : solid, 0.0, 0.0, length_m, painted}};
}

// The lanes of both directions between two stations.
struct Slice {
  std::vector<std::pair<std::size_t, std::size_t>> forward, backward;  // left and right borders
};

Slice slice_between(const std::vector<Border>& borders, double from_m, double to_m) {
  const double mid_m = 0.5 * (from_m + to_m);
  std::vector<std::size_t> active;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    if (borders[i].from_m < mid_m && mid_m < borders[i].to_m) active.push_back(i);
  }
  std::stable_sort(active.begin(), active.end(), [&](std::size_t a, std::size_t b) {
    return borders[a].left_m.at(mid_m) > borders[b].left_m.at(mid_m);
  });
  Slice slice;
  for (std::size_t i = 1; i < active.size(); ++i) {
    const Profile &left = borders[active[i - 1]].left_m, &right = borders[active[i]].left_m;
    const auto wide = [&](double s_m) { return left.at(s_m) - right.at(s_m) > kMinLaneWidth_m - kTiny_m; };
    if (!wide(from_m) || !wide(to_m)) continue;
    const bool is_forward = left.at(mid_m) + right.at(mid_m) < 0.0;
    (is_forward ? slice.forward : slice.backward).emplace_back(active[i - 1], active[i]);
  }
  return slice;
}

}  // namespace

double half_width_m(int lanes, CentreLine centre, double lane_width_m) {
  return (centre == CentreLine::double_solid ? 0.5 * kDoubleLine_m : 0.0) + lanes * lane_width_m;
}

std::vector<Border> borders(const Section& section, double length_m) {
  std::vector<Border> all = middle_borders(section, length_m);
  const auto append = [&](bool right, const RoadHalf& side) {
    if (side.lanes == 0) return;
    for (Border& border : SideBorders(section, right, length_m).collect(side))
      all.push_back(std::move(border));
  };
  append(true, section.forward);
  append(false, section.backward);
  for (Border& border : all)
    if (border.type == MarkingType::roadedge) border.painted = section.visible_edges;
  return all;
}

std::vector<double> stations(const std::vector<Border>& borders, double from_m, double to_m) {
  std::vector<double> ends{from_m, to_m};
  for (const Border& border : borders) {
    for (const double end_m : {border.from_m, border.to_m}) {
      if (end_m > from_m + kTiny_m && end_m < to_m - kTiny_m) ends.push_back(end_m);
    }
  }
  std::sort(ends.begin(), ends.end());
  std::vector<double> out{from_m};
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double gap_m = ends[i] - ends[i - 1];
    if (gap_m < kTiny_m) continue;
    const int steps = std::max(1, static_cast<int>(std::ceil(gap_m / kGapStep_m - kTiny_m)));
    for (int k = 1; k <= steps; ++k) out.push_back(ends[i - 1] + gap_m * k / steps);
  }
  return out;
}

std::vector<LaneStretch> lane_stretches(const std::vector<Border>& borders, double length_m) {
  const std::vector<double> all = stations(borders, 0.0, length_m);
  std::vector<LaneStretch> out;
  for (const bool forward : {true, false}) {
    std::vector<std::pair<std::size_t, std::size_t>> before;
    std::size_t first = out.size();  // index of the first stretch that goes on
    for (std::size_t i = 1; i < all.size(); ++i) {
      const Slice slice = slice_between(borders, all[i - 1], all[i]);
      const auto& now = forward ? slice.forward : slice.backward;
      if (now != before) {
        first = out.size();
        for (const auto& [left, right] : now) out.push_back({left, right, forward, {all[i - 1]}});
        before = now;
      }
      for (std::size_t k = first; k < out.size(); ++k) out[k].stations_m.push_back(all[i]);
    }
  }
  return out;
}

}  // namespace laneloom::simulation
