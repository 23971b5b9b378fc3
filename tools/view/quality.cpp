#include "view/quality.hpp"

#include <algorithm>

#include "drawing/lane_role.hpp"
#include "evaluation/kind_lines.hpp"
#include "evaluation/profile.hpp"

namespace laneloom::view {
namespace {

constexpr std::size_t kTenMetres = 1;  ///< index in evaluation::kJumpsAhead_m
static_assert(evaluation::kJumpsAhead_m[kTenMetres] == 10.0);

std::optional<MapQuality::Later> proved(evaluation::LaterMeter& meter) {
  const evaluation::LaterScore score = meter.take_scores();
  if (score.seen_later == 0) return std::nullopt;
  const auto [precision, recall, rms_m, p95_m] = score.figures(score.map);
  return MapQuality::Later{meter.rated_ns(), recall, precision, rms_m};
}

}  // namespace

QualityMeter::QualityMeter(const RangeConfig& range, const simulation::Road* truth) : range_(range) {
  if (truth == nullptr) return;
  truth_ = evaluation::kind_lines(*truth);
  std::erase_if(truth_,
                [](const evaluation::KindLine& line) { return line.kind == evaluation::LineKind::lane; });
}

MapQuality QualityMeter::next(const LocalMap& map, const DetectionFrame* detections) {
  MapQuality quality{.own_lane = drawing::own_lane_of(map), .lanes = map.lanes.size()};
  if (const auto step = steps_.next(map)) {
    if (const Distribution& jump = step->jump_m[kTenMetres]; jump.count() > 0) quality.jump_m = jump.mean();
    quality.unsteady = step->blinks + step->turned + step->doubted;
    quality.own_changed = step->own_changes > 0;
  }
  if (!truth_.empty()) rate_by_truth(map, quality);
  if (detections != nullptr) {
    later_.add(*detections, map.T_map_body, map);
    quality.later = proved(later_);
  }
  return quality;
}

void QualityMeter::rate_by_truth(const LocalMap& map, MapQuality& quality) const {
  evaluation::ProfileMeter profile(range_);
  profile.add(evaluation::compare(truth_, evaluation::kind_lines(map), map.T_map_body, range_));
  const evaluation::SampleScore& score = profile.over_time().front().score;
  if (score.truths > 0) quality.recall = score.recall();
  if (score.right > 0) quality.lateral_error_m = score.lateral_error_m();
}

}  // namespace laneloom::view
