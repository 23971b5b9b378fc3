#pragma once

#include <span>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/detection_model.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/id_source.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom {

/// What a frame can say of the map.
struct View {
  Eigen::Isometry3d T_body_map = Eigen::Isometry3d::Identity();
  const DetectionFrame* frame = nullptr;
  double news = 1.0;  ///< how much of it is: evidence counts by independent views, not by frames

  bool is_independent() const { return news >= 1.0; }
  /// Whether the network detects markings of `type`.
  bool detects(MarkingType type) const;
  /// Whether nothing is told of places that it cannot see.
  bool unlimited() const;

  /// Whether a marking of `type` at a point of the map would have been seen.
  bool sees(const Point& point_map, MarkingType type, const MapBox& range) const;
};

/// Log odds that a line exists: what its stations say on average, and what its confidences say.
double existence(std::span<const Station> stations, const Confidences& confidences);

/// Notes one more confidence of a line.
void add_confidence(const SampledDetection& detection, const Point& origin, double news,
                    const DetectionModel& model, Line& line);

/// Raises the evidence of what was observed. The model learns the confidences of established lines.
void credit_observed(const View& view, const Association& association, const FusionConfig& config,
                     DetectionModel& model, std::vector<Line>& lines);

/// Lowers the evidence of the stations that were in view and not observed, as far as the network sees what is
/// there. The model learns how often it sees established lines, within the range and its margin.
void discount_unobserved(const View& view, const MapBox& range, const FusionConfig& config,
                         DetectionModel& model, std::vector<Line>& lines);

/// Takes away what has lost its evidence or left the range: ends are cut, a line that is lost in between is
/// split. Its longest piece keeps the id; returns the others, each with the line that it was cut off from.
/// The model learns which lines were wrong. Of more than 256 lines, those that are believed least go.
std::vector<Relative> prune_lines(const MapBox& range, const FusionConfig& config, DetectionModel& model,
                                  std::vector<Line>& lines, IdSource& ids);

}  // namespace laneloom
