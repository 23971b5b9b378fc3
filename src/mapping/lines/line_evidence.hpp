#pragma once

#include <cstddef>
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

namespace laneloom::lines {

/// The inside of a polygon, seen from above. The polygon must outlive it; an empty one contains nothing.
class Outline {
 public:
  explicit Outline(const Polyline& polygon);
  bool contains(const Point& point) const;

 private:
  const Polyline* polygon_;
  Eigen::AlignedBox2d bounds_;
};

/// The view of a frame on the map.
struct View {
  /// `transform` is T_body_map, `weight` is the news, and `least` the least news. The frame must outlive the
  /// view.
  View(const Eigen::Isometry3d& transform, const DetectionFrame& of, double weight = 1.0, double least = 0.0);

  Eigen::Isometry3d T_body_map;
  const DetectionFrame* frame;  ///< the frame that sees
  double news;        ///< 0..1; 1 is an independent view. Evidence counts by independent views, not by frames
  double least_news;  ///< at a place that is not confirmed yet

  bool is_independent() const { return news >= 1.0; }
  /// Whether the network detects markings of `type`.
  bool detects(MarkingType type) const;
  /// Whether the frame names neither a field of view nor occluded areas.
  bool unlimited() const;

  /// Whether a marking of `type` at a point of the map would have been seen.
  bool sees(const Point& point_map, MarkingType type, const geometry::MapBox& range) const;

 private:
  Outline field_of_view_;
  std::vector<Outline> occluded_areas_;
};

/// Log odds that a line exists, by the beliefs in its detections alone.
double log_odds(const Beliefs& beliefs);

/// Log odds that a line exists: the mean of its stations plus those of its beliefs.
double existence(std::span<const Station> stations, const Beliefs& beliefs);

/// Adds the belief in one more detection to a line, once the model knows the network's confidences.
void add_belief(double belief, double news, const DetectionModel& model, Line& line);

/// Raises the evidence of the stations that were observed. The model learns the confidences of established
/// lines.
void credit_observed(const View& view, const Association& association, const FusionConfig& config,
                     DetectionModel& model, std::vector<Line>& lines);

/// Lowers the evidence of the stations that were in view and not observed, the more the more reliably the
/// network sees lines there. The model learns how often it sees established lines, within the range and its
/// margin.
void discount_unobserved(const View& view, const geometry::MapBox& range, const FusionConfig& config,
                         DetectionModel& model, std::vector<Line>& lines);

/// Removes stations that have lost their evidence or left the range. A line that loses stations in between is
/// split; its longest piece keeps the id. Returns the other pieces, each with the line that it was cut off
/// from.
std::vector<markings::Relative> prune_lines(const geometry::MapBox& range, const FusionConfig& config,
                                            std::vector<Line>& lines, markings::IdSource& ids);

}  // namespace laneloom::lines
