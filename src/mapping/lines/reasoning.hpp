#pragma once

#include <map>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/reasons.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/pair_history.hpp"
#include "mapping/markings/preprocess.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom::lines {

/// Notes the reasons of one frame, step by step in the order of its functions. Without a place to note them
/// to, every function returns at once. Not thread-safe.
class Reasoning {
 public:
  /// `to` may be null. `lines` are those before the frame.
  Reasoning(FrameReasons* to, const markings::ObservedFrame& observed, const std::vector<Line>& lines);

  /// The detections that are sure enough.
  void believed(const std::vector<markings::ObservedMarking>& markings);
  /// The detections that observe lines, before the lines change.
  void associated(const Association& association, const std::vector<Line>& lines);
  /// The lines with the evidence of this frame, before they grow.
  void updated(const std::vector<Line>& lines, const FusionConfig& config);
  /// A line that begins.
  void born(const Line& line, const std::vector<SampledDetection>& detections);
  /// The lines after the frame, and what was published of them.
  void decided(const std::vector<Line>& lines, const markings::PairHistories& doubles,
               const std::vector<Marking>& published, const MapperConfig& config);
  /// The lines that ended. `relatives` are those that are part of others now.
  void ended(const std::vector<markings::Relative>& relatives, const geometry::MapBox& box);

 private:
  /// A line before the frame.
  struct Before {
    MarkingType type;
    std::vector<Point> places;
    double log_odds = 0.0;  ///< mean of its stations
  };

  LineReason& of(const Line& line);

  FrameReasons* to_;
  std::vector<markings::ObservedMarking> believed_;
  std::map<ElementId, Before> before_;
  std::map<ElementId, LineReason> lines_;
};

}  // namespace laneloom::lines
