#include "mapping/lines/joints.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace laneloom {
namespace {

constexpr double kEndStations = 3.0;  // from an end, within which a detection saw it

/// The detections that saw each end of a line: its first station and its last one.
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

/// What says whether two lines meet: their ends, seen from above.
struct Ends {
  std::array<Eigen::Vector2d, 2> at;
  bool of_stopline = false;
};

std::vector<Ends> ends_of(const std::vector<Line>& lines) {
  std::vector<Ends> ends;
  ends.reserve(lines.size());
  for (const Line& line : lines)
    ends.push_back({{line.stations.front().position.head<2>(), line.stations.back().position.head<2>()},
                    is_stopline(line.type())});
  return ends;
}

bool shared(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  return std::ranges::find_first_of(a, b) != a.end();
}

}  // namespace

void count_joints(const std::vector<LineMatch>& matches, const std::vector<Line>& lines, double max_gap_m,
                  PairHistories& joints) {
  const std::vector<Views> views = views_of_ends(matches, lines);
  const std::vector<Ends> ends = ends_of(lines);
  PairHistories counted;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (ends[i].of_stopline) continue;
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      if (ends[j].of_stopline) continue;
      for (const auto& [end_i, end_j] : {std::pair(0U, 0U), {0U, 1U}, {1U, 0U}, {1U, 1U}}) {
        if ((ends[i].at[end_i] - ends[j].at[end_j]).squaredNorm() > max_gap_m * max_gap_m) continue;
        const bool one = shared(views[i][end_i], views[j][end_j]);
        const bool two = !one && !views[i][end_i].empty() && !views[j][end_j].empty();
        counted.push_back(
            continued(joints, end_id(lines[i].id, end_i == 1), end_id(lines[j].id, end_j == 1), one, two));
      }
    }
  }
  sort(counted);
  joints = std::move(counted);
}

}  // namespace laneloom
