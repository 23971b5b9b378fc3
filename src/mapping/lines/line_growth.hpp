#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/local_range.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/detection_model.hpp"
#include "mapping/lines/line_map.hpp"

namespace laneloom {

/// Continues lines where a detection runs on beyond their ends, in its own order: round a sharp tip, too. As
/// far as the range goes.
void extend_lines(const std::vector<LineMatch>& matches, const Point& origin, const LocalRange& range,
                  const FusionConfig& config, std::vector<SampledDetection>& detections,
                  std::vector<Line>& lines);

/// New lines from what no line explains.
void create_lines(const std::vector<SampledDetection>& detections, const Point& origin, std::int64_t stamp_ns,
                  const LocalRange& range, const FusionConfig& config, const DetectionModel& model,
                  std::vector<Line>& lines, ElementId& next_id);

}  // namespace laneloom
