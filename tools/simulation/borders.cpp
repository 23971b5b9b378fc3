#include "simulation/borders.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kMinAlignment = 0.9;  // cosine between the directions of lines that continue one another

constexpr double kRepeated_m = 0.05;  // two points of a joint that are nearer are one

struct MarkingEnd {
  std::size_t marking = 0;
  bool at_back = false;
};

const Point& point_at(const std::vector<RoadMarking>& markings, const MarkingEnd& end) {
  const Polyline& points = markings[end.marking].points;
  return end.at_back ? points.back() : points.front();
}

bool is_ring(const Polyline& points) {
  return points.size() > 3 && (points.front() - points.back()).norm() < 1e-6;
}

// The only other end at `end`, if it continues `end`, or else `end` itself.
MarkingEnd continuation(const std::vector<RoadMarking>& markings, const MarkingEnd& end, double tolerance_m) {
  MarkingEnd partner = end;
  int others = 0;
  for (std::size_t i = 0; i < markings.size(); ++i) {
    if (markings[i].type != markings[end.marking].type || markings[i].style != markings[end.marking].style ||
        markings[i].points.empty())
      continue;
    for (const bool at_back : {false, true}) {
      if (i == end.marking && at_back == end.at_back) continue;
      const MarkingEnd other{i, at_back};
      if ((point_at(markings, other) - point_at(markings, end)).norm() > tolerance_m) continue;
      partner = other;
      ++others;
    }
  }
  if (others != 1) return end;
  const auto outward = [&](const MarkingEnd& e) {
    return end_direction(markings[e.marking].points, e.at_back ? End::back : End::front, 1.0);
  };
  return outward(end).dot(outward(partner)) < -kMinAlignment ? partner : end;
}

// Appends the marking of `next` to that of `end`, which both end there.
void append(std::vector<RoadMarking>& markings, const MarkingEnd& end, const MarkingEnd& next) {
  Polyline& points = markings[end.marking].points;
  if (next.marking == end.marking) {
    if ((points.back() - points.front()).norm() < kRepeated_m)
      points.back() = points.front();
    else
      points.push_back(points.front());
    return;
  }
  Polyline added = std::exchange(markings[next.marking].points, {});
  if (!end.at_back) std::reverse(points.begin(), points.end());
  if (next.at_back) std::reverse(added.begin(), added.end());
  const bool repeated = (points.back() - added.front()).norm() < kRepeated_m;
  points.insert(points.end(), added.begin() + (repeated ? 1 : 0), added.end());
  if (!end.at_back) std::reverse(points.begin(), points.end());
}

bool runs_along(const Polyline& samples, const MeasuredPolyline& line, double tolerance_m) {
  const auto near = std::ranges::count_if(samples, [&](const Point& point) {
    const Projection foot = line.project(point, tolerance_m);
    return foot.distance_m < tolerance_m && std::abs(foot.foot.z() - point.z()) < 1.0;
  });
  return 5 * near >= 4 * static_cast<std::ptrdiff_t>(samples.size());
}

}  // namespace

bool LengthLimit::add(const Polyline& line) {
  total_m_ += length(line);
  return total_m_ <= 300e3;
}

Polyline midway(const Polyline& left, const Polyline& right, double step_m) {
  const MeasuredPolyline a(left), b(right);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::max(a.length(), b.length()) / step_m)));
  Polyline out;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    out.push_back(0.5 * (a.at(share * a.length()) + b.at(share * b.length())));
  }
  return out;
}

bool has_lines(const Road& road) {
  return std::ranges::any_of(road.markings, [](const RoadMarking& marking) {
    return marking.type == MarkingType::laneline || marking.type == MarkingType::roadedge;
  });
}

void join_markings(Road& road, double tolerance_m) {
  std::vector<RoadMarking>& markings = road.markings;
  std::map<ElementId, ElementId> joined_into;  // former id, id of the marking that it was appended to
  for (std::size_t i = 0; i < markings.size(); ++i) {
    for (const bool at_back : {true, false}) {
      while (!markings[i].points.empty() && !is_ring(markings[i].points)) {
        const MarkingEnd end{i, at_back};
        const MarkingEnd next = continuation(markings, end, tolerance_m);
        if (next.marking == i && next.at_back == at_back) break;
        joined_into[markings[next.marking].id] = markings[i].id;
        append(markings, end, next);
      }
    }
  }
  std::erase_if(markings, [](const RoadMarking& marking) { return marking.points.empty(); });

  std::map<ElementId, ElementId> new_id{{kNoElement, kNoElement}};
  for (std::size_t i = 0; i < markings.size(); ++i) {
    new_id[markings[i].id] = i + 1;
    if (is_ring(markings[i].points)) markings[i].points.back() = markings[i].points.front();
    markings[i].id = i + 1;
  }
  const auto follow = [&](ElementId id) {
    for (auto it = joined_into.find(id); it != joined_into.end() && it->second != id;
         it = joined_into.find(id))
      id = it->second;
    return new_id.at(id);
  };
  for (RoadLane& lane : road.lanes) {
    lane.left_marking = follow(lane.left_marking);
    lane.right_marking = follow(lane.right_marking);
  }
}

void attach_markings(Road& road, MarkingType type, double tolerance_m) {
  std::vector<std::pair<ElementId, MeasuredPolyline>> lines;
  for (const RoadMarking& marking : road.markings)
    if (marking.type == type) lines.emplace_back(marking.id, marking.points);
  const auto marking_along = [&](const Polyline& border) {
    const Polyline samples = resample(border, 1.0);
    const auto found = std::ranges::find_if(
        lines, [&](const auto& line) { return runs_along(samples, line.second, tolerance_m); });
    return found == lines.end() ? kNoElement : found->first;
  };
  for (RoadLane& lane : road.lanes) {
    if (lane.left_marking == kNoElement) lane.left_marking = marking_along(lane.left);
    if (lane.right_marking == kNoElement) lane.right_marking = marking_along(lane.right);
  }
}

}  // namespace laneloom::simulation
