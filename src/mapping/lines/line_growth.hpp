#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/detection_model.hpp"
#include "mapping/lines/line_map.hpp"

namespace laneloom {

/// Continues lines where a detection runs on beyond their ends, in its own order: round a sharp tip, too. As
/// far as the range goes. Marks the samples that the lines then explain.
void extend_lines(const Point& origin, const MapBox& box, const FusionConfig& config,
                  Association& association, std::vector<Line>& lines);

/// New lines from what no line explains, without ids and stamps.
std::vector<Line> new_lines(const std::vector<SampledDetection>& detections, const Point& origin,
                            const MapBox& box, const FusionConfig& config, const DetectionModel& model);

}  // namespace laneloom
