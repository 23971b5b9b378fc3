#include "session/source_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/map_fit.hpp"

namespace laneloom::session {
namespace {

// A source that hangs for a moment keeps its place before one that contradicts it.
constexpr std::int64_t kSilent_ns = 10'000'000'000;
constexpr double kNewShare = 0.2;  // of a frame in the contradiction
constexpr double kAgrees = 0.6;    // share of what two frames have in common that lies where it should
constexpr double kLeastShared_m = 20.0;
// Lines that lie further beside are other lines: the next one of a narrow lane may be as near.
constexpr double kFurthest_m = 2.0, kStep_m = 0.25;
constexpr double kDeviations = 3.0, kLeastBeside_m = 0.75;
constexpr double kTypicalRange_m = 15.0;  // at which a deviation stands for a frame

std::vector<Marking> in_map(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
  std::vector<Marking> lines;
  for (const Detection& detection : frame.detections) {
    Marking& line = lines.emplace_back(Marking{.type = detection.type});
    for (const Point& point : detection.points) line.points.push_back(T_map_body * point);
  }
  return lines;
}

/// The frame and the lines of one type: a network may take for an edge where another one sees paint.
class Fits {
 public:
  Fits(const DetectionFrame& frame, const std::vector<Marking>& lines, const Eigen::Isometry3d& T_map_body)
      : T_map_body_(T_map_body) {
    for (const MarkingType type : {MarkingType::laneline, MarkingType::roadedge}) {
      DetectionFrame of_type;
      std::ranges::copy_if(frame.detections, std::back_inserter(of_type.detections),
                           [type](const Detection& detection) { return detection.type == type; });
      std::vector<Marking> lines_of_type;
      std::ranges::copy_if(lines, std::back_inserter(lines_of_type),
                           [type](const Marking& line) { return line.type == type; });
      const MapFit& fit = fits_.emplace_back(of_type, lines_of_type, T_map_body);
      double length_m = 0.0;
      for (const Marking& line : lines_of_type) length_m += length(line.points);
      comparable_m_ += std::min(length_m, fit.length_m());
    }
  }
  /// The length of the frame's lines that lie on the others where the frame lies so far to the left.
  double shared_m(double left_m) const {
    const Eigen::Isometry3d moved = T_map_body_ * Eigen::Translation3d(0.0, left_m, 0.0);
    double sum_m = 0.0;
    for (const MapFit& fit : fits_) sum_m += fit.explained_m(moved);
    return sum_m;
  }
  /// The most that the two can have in common.
  double comparable_m() const { return comparable_m_; }

 private:
  Eigen::Isometry3d T_map_body_;
  std::vector<MapFit> fits_;
  double comparable_m_ = 0.0;
};

/// By how much the lines of a frame lie to the left of others. None: they have too little in common.
std::optional<double> beside_m(const Fits& fits) {
  const double enough_m = std::max(kLeastShared_m, kAgrees * fits.comparable_m());
  const double here_m = fits.shared_m(0.0);
  if (here_m >= enough_m) return 0.0;
  double best_m = 0.0, most_m = here_m;
  for (double left_m = -kFurthest_m; left_m <= kFurthest_m; left_m += kStep_m) {
    const double shared_m = fits.shared_m(left_m);
    if (shared_m <= most_m) continue;
    most_m = shared_m;
    best_m = left_m;
  }
  if (most_m < enough_m) return std::nullopt;
  return here_m < kAgrees * most_m ? -best_m : 0.0;
}

}  // namespace

bool SourceAgreement::may_fuse(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                               std::int64_t arrival_ns) {
  forget_silent(arrival_ns);
  auto source = std::ranges::find(sources_, frame.source, &Source::name);
  if (source == sources_.end()) source = sources_.insert(sources_.end(), Source{.name = frame.source});
  source->arrival_ns = arrival_ns;
  const DetectionFrame told = trusted(frame);
  source->stddev_m = stddev_m(told);
  compare(told, T_map_body, *source);
  if (frame.stamp_ns >= source->stamp_ns) {
    source->stamp_ns = frame.stamp_ns;
    source->lines = in_map(told, T_map_body);
  }
  return !source->disagrees();
}

/// The frame without the detections that the mapper drops.
DetectionFrame SourceAgreement::trusted(const DetectionFrame& frame) const {
  DetectionFrame kept{.stamp_ns = frame.stamp_ns, .source = frame.source};
  std::ranges::copy_if(frame.detections, std::back_inserter(kept.detections),
                       [this](const Detection& one) { return one.confidence >= min_confidence_; });
  return kept;
}

void SourceAgreement::forget() {
  for (Source& source : sources_) {
    source.stamp_ns = 0;
    source.lines.clear();
  }
}

/// Forgets sources of which nothing came for a while. Who comes back comes last. Stamps tell no silence: a
/// slow network's are always behind those of a fast one.
void SourceAgreement::forget_silent(std::int64_t arrival_ns) {
  std::erase_if(sources_,
                [arrival_ns](const Source& source) { return arrival_ns - source.arrival_ns > kSilent_ns; });
  for (Source& source : sources_)
    if (source.disagrees() && std::ranges::find(sources_, source.other, &Source::name) == sources_.end())
      source.contradiction = kAtFirst;
}

/// Compares a frame with the first source before its own one that tells something. A source that disagrees
/// itself tells nothing.
void SourceAgreement::compare(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                              Source& source) const {
  for (const Source& other : sources_) {
    if (other.name == source.name) return;
    if (other.disagrees()) continue;
    const auto beside = beside_m(Fits(frame, other.lines, T_map_body));
    if (!beside) continue;
    const double limit_m =
        std::max(kLeastBeside_m, kDeviations * std::hypot(source.stddev_m, other.stddev_m));
    const double contradicts = std::abs(*beside) >= limit_m ? 1.0 : 0.0;
    if (source.other != other.name) source.contradiction = kAtFirst;
    source.contradiction += kNewShare * (contradicts - source.contradiction);
    if (contradicts > 0.0) source.beside_m = *beside;
    source.other = other.name;
    return;
  }
}

/// The lateral deviation of a frame's lines: as it says, or as networks have it in general.
double SourceAgreement::stddev_m(const DetectionFrame& frame) const {
  double sum_m = 0.0, values = 0.0;
  for (const Detection& detection : frame.detections)
    for (const double stddev_m : detection.stddev_m) {
      sum_m += stddev_m;
      values += 1.0;
    }
  return values > 0.0 ? sum_m / values : fusion_.stddev_m + fusion_.stddev_per_m * kTypicalRange_m;
}

std::vector<Disagreement> SourceAgreement::disagreements() const {
  std::vector<Disagreement> found;
  for (const Source& source : sources_)
    if (source.disagrees()) found.push_back({source.name, source.other, source.beside_m});
  return found;
}

}  // namespace laneloom::session
