#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "evaluation/evaluation.hpp"
#include "evaluation/later.hpp"
#include "evaluation/steadiness.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "simulation/road.hpp"

namespace laneloom::view {

/// The figures of one map that a planner cares for. What is empty is not known, or not yet.
struct MapQuality {
  /// How a frame from a while ago proved, by what was seen later from close by (evaluation/later.hpp).
  struct Later {
    std::int64_t stamp_ns = 0;  ///< of that frame
    std::optional<double> recall, precision, lateral_error_m;
  };

  ElementId own_lane = kNoElement;  ///< kNoElement: the vehicle drives in no lane of the map
  std::size_t lanes = 0;
  std::optional<double> jump_m;         ///< of the way since the map before, 10 m ahead, to a side
  std::optional<std::size_t> unsteady;  ///< number of lanes that blinked, turned round or changed direction
  bool own_changed = false;             ///< the own lane has another id, and no linkage joins the two
  std::optional<double> lateral_error_m, recall;  ///< by the truth, over all markings in range
  std::optional<Later> later;
};

/// Rates maps one after the other. Definitions are those of `laneloom evaluate`. Not thread-safe.
class QualityMeter {
 public:
  /// `truth` may be null, and must outlive this.
  QualityMeter(const RangeConfig& range, const simulation::Road* truth);

  /// Rates the next map. `detections` are those of the map's last frame; null: they are not known.
  MapQuality next(const LocalMap& map, const DetectionFrame* detections);

 private:
  void rate_by_truth(const LocalMap& map, MapQuality& quality) const;

  RangeConfig range_;
  std::vector<evaluation::KindLine> truth_;
  evaluation::SteadinessSteps steps_;
  evaluation::LaterMeter later_{PreprocessConfig{}.min_confidence};
};

}  // namespace laneloom::view
