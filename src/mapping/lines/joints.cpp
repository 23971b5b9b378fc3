#include "mapping/lines/joints.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace laneloom::lines {
namespace {

constexpr double kEndStations = 3.0;  // a detection that came this near to an end saw it

/// The detections that saw each end of a line, the front and the back.
using Views = std::array<std::vector<std::size_t>, 2>;

std::vector<Views> views_of_ends(const std::vector<LineMatch>& matches, const std::vector<Line>& lines) {
  std::vector<Views> views(lines.size());
  for (const LineMatch& match : matches) {
    const auto last = static_cast<double>(lines[match.line].stations.size() - 1);
    const auto [lowest, highest] =
        std::ranges::minmax(match.samples, {}, [](const SampleMatch& s) { return s.foot.index; });
    if (lowest.foot.index <= kEndStations) views[match.line][0].push_back(match.detection);
    if (highest.foot.index >= last - kEndStations) views[match.line][1].push_back(match.detection);
  }
  return views;
}

/// An end of a line that may meet an end of another line, seen from above.
struct LineEnd {
  ElementId line = kNoElement;
  End end = End::front;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  const std::vector<std::size_t>* views = nullptr;

  ElementId id() const { return markings::end_id(line, end); }
};

/// The ends of the lines, by ascending id. Stoplines are left out, since nothing continues them.
std::vector<LineEnd> ends_of(const std::vector<Line>& lines, const std::vector<Views>& views) {
  std::vector<LineEnd> ends;
  ends.reserve(2 * lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    if (is_stopline(line.type())) continue;
    ends.push_back({line.id, End::front, line.stations.front().position.head<2>(), &views[i][0]});
    ends.push_back({line.id, End::back, line.stations.back().position.head<2>(), &views[i][1]});
  }
  std::ranges::sort(ends, {}, &LineEnd::id);
  return ends;
}

bool shared(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  return std::ranges::find_first_of(a, b) != a.end();
}

}  // namespace

void count_joints(const std::vector<LineMatch>& matches, const std::vector<Line>& lines, double max_gap_m,
                  markings::PairHistories& joints) {
  const std::vector<Views> views = views_of_ends(matches, lines);
  const std::vector<LineEnd> ends = ends_of(lines, views);
  std::vector<markings::PairSighting> near;
  near.reserve(ends.size());
  for (auto a = ends.begin(); a != ends.end(); ++a) {
    for (auto b = a + 1; b != ends.end(); ++b) {
      if (a->line == b->line || (a->place - b->place).squaredNorm() > max_gap_m * max_gap_m) continue;
      const bool together = shared(*a->views, *b->views);
      const bool apart = !together && !a->views->empty() && !b->views->empty();
      near.push_back({a->id(), b->id(), together, apart});
    }
  }
  joints = continued(joints, near);
}

}  // namespace laneloom::lines
