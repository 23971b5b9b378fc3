#include "mapping/association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kMaxHeight_m = 2.0;  // a line this far above or below is on another road

struct Candidate {
  double score = 0.0;
  LineMatch match;
};

Eigen::Vector2d direction_of(const Polyline& samples, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = std::min(i + 1, samples.size() - 1);
  return (samples[after] - samples[before]).head<2>().normalized();
}

/// A line's station that is nearest to a point.
struct Nearest {
  std::uint32_t line = 0;
  std::uint32_t station = 0;
  double squared_m2 = 0.0;  ///< its distance
};

/// Finds for a point the nearest station of every line beside it. Keeps its memory from point to point.
class NearestStations {
 public:
  explicit NearestStations(const std::vector<Line>& lines) : grid_(lines), slots_(lines.size(), kNone) {}

  /// By line, in no meaningful order; good until the next call.
  const std::vector<Nearest>& around(const Point& point, bool on_stopline) {
    for (const Nearest& nearest : near_) slots_[nearest.line] = kNone;
    near_.clear();
    grid_.around(point, [&](const StationGrid::Entry& entry) {
      if (entry.on_stopline != on_stopline) return;
      const Point offset = entry.position - point;
      if (std::abs(offset.z()) > kMaxHeight_m) return;
      const double squared_m2 = offset.head<2>().squaredNorm();
      std::uint32_t& slot = slots_[entry.line];
      if (slot == kNone) {
        slot = static_cast<std::uint32_t>(near_.size());
        near_.push_back({entry.line, entry.station, squared_m2});
      } else if (squared_m2 < near_[slot].squared_m2) {
        near_[slot] = {entry.line, entry.station, squared_m2};
      }
    });
    return near_;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  StationGrid grid_;
  std::vector<std::uint32_t> slots_;  ///< by line: where in near_ it is
  std::vector<Nearest> near_;
};

/// Whether `point` lies within the gate of the line's course before or after a station: without it, no foot
/// there does. Needs no root and no quotient.
bool may_lie_within(double gate_m, const Line& line, std::size_t nearest, const Point& point) {
  constexpr double kRounding = 1.0 + 1e-9;
  const auto& stations = line.stations;
  const std::size_t first = nearest == 0 ? 0 : nearest - 1;
  const std::size_t last = std::min(nearest + 1, stations.size() - 1);
  for (std::size_t i = first; i < last; ++i) {
    const Eigen::Vector2d along = (stations[i + 1].position - stations[i].position).head<2>();
    const double area_m2 = cross(along, (point - stations[i].position).head<2>());
    if (area_m2 * area_m2 <= kRounding * gate_m * gate_m * along.squaredNorm()) return true;
  }
  return false;
}

/// All lines that a detection's samples lie beside, with the samples that do.
void find_candidates(std::size_t index, const SampledDetection& detection, const std::vector<Line>& lines,
                     double min_cosine, double gate_m, NearestStations& nearest_stations,
                     std::vector<Candidate>& candidates) {
  std::map<std::uint32_t, Candidate> by_line;
  for (std::size_t i = 0; i < detection.samples.size(); ++i) {
    const Point& point = detection.samples[i];
    for (const Nearest& n : nearest_stations.around(point, is_stopline(detection.type))) {
      const Line& line = lines[n.line];
      if (!may_lie_within(gate_m, line, n.station, point)) continue;
      const StationFoot foot = foot_at(line, n.station, point);
      const double last = static_cast<double>(line.stations.size() - 1);
      if (foot.index < -0.5 || foot.index > last + 0.5 || std::abs(foot.lateral_m) > gate_m) continue;
      if (std::abs(direction_of(detection.samples, i).dot(direction_at(line, n.station))) < min_cosine)
        continue;
      Candidate& candidate = by_line[n.line];
      const double fit = foot.lateral_m / gate_m;
      candidate.score += 1.0 - fit * fit;
      candidate.match.samples.push_back({i, foot});
    }
  }
  for (auto& [line, candidate] : by_line) {
    candidate.match.detection = index;
    candidate.match.line = line;
    candidates.push_back(std::move(candidate));
  }
}

}  // namespace

std::vector<SampledDetection> sample_detections(const std::vector<ObservedMarking>& markings,
                                                const FusionConfig& config) {
  std::vector<SampledDetection> detections;
  detections.reserve(markings.size());
  for (const ObservedMarking& marking : markings) {
    const MeasuredPolyline line(marking.points);
    if (line.length() <= 0.0) continue;
    SampledDetection detection{
        line.resample(config.sample_step_m), marking.type, marking.style, marking.confidence, {}};
    detection.explained.assign(detection.samples.size(), false);
    detections.push_back(std::move(detection));
  }
  return detections;
}

std::vector<LineMatch> associate(const std::vector<Line>& lines, const FusionConfig& config,
                                 std::vector<SampledDetection>& detections) {
  const double min_cosine = cos_degrees(config.gate_angle_deg);
  NearestStations nearest_stations(lines);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    find_candidates(i, detections[i], lines, min_cosine, config.gate_m, nearest_stations, candidates);
  }
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::score);

  std::vector<std::vector<bool>> observed(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) observed[i].assign(lines[i].stations.size(), false);
  std::vector<LineMatch> matches;
  for (auto& [score, match] : candidates) {
    auto& explained = detections[match.detection].explained;
    auto& taken = observed[match.line];
    const auto station = [](const SampleMatch& s) {
      return static_cast<std::size_t>(std::lround(std::max(0.0, s.foot.index - 1e-6)));
    };
    std::erase_if(match.samples,
                  [&](const SampleMatch& s) { return explained[s.sample] || taken[station(s)]; });
    if (static_cast<double>(match.samples.size()) * config.sample_step_m < config.min_overlap_m) continue;
    for (const SampleMatch& s : match.samples) explained[s.sample] = true;
    const auto [first, last] =
        std::ranges::minmax(match.samples, {}, [](const SampleMatch& s) { return s.foot.index; });
    for (std::size_t k = station(first); k <= station(last); ++k) taken[k] = true;
    matches.push_back(std::move(match));
  }
  return matches;
}

}  // namespace laneloom
