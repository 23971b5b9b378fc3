#pragma once

#include <vector>

#include "evaluation/evaluation.hpp"
#include "experiment/drive_simulation.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::experiment {

/// A causal fusion without any error of association. It is told the true marking of every detection and its
/// type. It gives the plain mean of all detections of a marking so far, metre by metre. It knows no lanes.
/// Not thread-safe.
class Oracle {
 public:
  explicit Oracle(const simulation::Road& truth);

  /// The map after one more frame: boundaries and stoplines in the map frame.
  LocalMap update(const SimulatedFrame& frame);

 private:
  struct Station {
    Point point = Point::Zero();  ///< on the marking
    Eigen::Vector2d left = Eigen::Vector2d::Zero();
    double offsets_m = 0.0;  ///< sum of all lateral offsets
    std::size_t count = 0;
  };
  struct Line {
    ElementId id = kNoElement;
    MarkingType type = MarkingType::laneline;
    MarkingStyle style = MarkingStyle::unknown;
    std::vector<Station> stations;
  };
  static void observe(const Polyline& points_map, Line& line);
  static void publish(const Line& line, LocalMap& map);

  std::vector<Line> lines_;
};

}  // namespace laneloom::experiment
