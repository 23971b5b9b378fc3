#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/detection_model.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/lines/station_update.hpp"

namespace laneloom::lines {

/// Extends lines where a detection runs on beyond their ends, within the range. The new stations follow the
/// order of the detection, also round a sharp tip. Marks the samples that the lines then explain.
void extend_lines(const Viewpoint& from, const geometry::MapBox& box, const FusionConfig& config,
                  Association& association, std::vector<Line>& lines);

/// Makes new lines of the parts of detections that no line explains. They have no ids and stamps.
std::vector<Line> new_lines(const std::vector<SampledDetection>& detections, const Viewpoint& from,
                            const geometry::MapBox& box, const FusionConfig& config,
                            const DetectionModel& model);

}  // namespace laneloom::lines
