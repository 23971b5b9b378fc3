#pragma once

#include <array>

#include "evaluation/average_precision.hpp"
#include "evaluation/evaluation.hpp"
#include "evaluation/kind_lines.hpp"
#include "evaluation/lane_metres.hpp"
#include "evaluation/linkages.hpp"
#include "evaluation/profile.hpp"
#include "evaluation/stability.hpp"
#include "evaluation/steadiness.hpp"
#include "evaluation/styles.hpp"
#include "evaluation/top_ll.hpp"
#include "evaluation/trust.hpp"

namespace laneloom::evaluation {

/// The subject of an evaluation. Detections have no lanes, so that they are not rated by them.
enum class Subject : std::uint8_t { maps, detections };

/// The outcome of an evaluation. Outcomes of several drives can be added.
struct Measures {
  MapScore score;
  std::array<Stability, kLineKindCount> stability;
  Trust markings, lanes;
  StyleScore styles;
  TopologyScore topology;
  TopLl top_ll;
  AveragePrecisionMeter average_precision;
  Steadiness steadiness;
  LaneMetres lane_metres;

  /// The stability of lanelines, roadedges and stoplines together.
  Stability markings_stability() const;
  Measures& operator+=(const Measures& other);
};

/// Every measure of a sequence of maps, or of single detections. Not thread-safe.
class MapEvaluation {
 public:
  MapEvaluation(const simulation::Road& truth, const RangeConfig& range, Subject subject);

  /// Adds the next frame, in the order of stamps. It is a map or a frame of detections, as the constructor
  /// was told.
  void add(const LocalMap& map);
  void add(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, double min_confidence);

  const MapScore& score() const { return score_; }
  const StabilityMeter& stability() const { return stability_; }
  const AveragePrecisionMeter& average_precision() const { return average_precision_; }
  const TrustMeter& trust() const { return trust_; }
  const ProfileMeter& profile() const { return profile_; }
  const StyleScore& styles() const { return styles_; }
  const TopologyScore& topology() const { return topology_; }
  const TopLl& top_ll() const { return top_ll_; }
  Steadiness steadiness() const { return steadiness_.steadiness(); }  ///< no maps where detections are rated
  const LaneMetres& lane_metres() const { return lane_metres_.metres(); }  ///< likewise
  Measures measures() const;

 private:
  FrameComparison add_lines(std::int64_t stamp_ns, const Eigen::Isometry3d& T_map_body,
                            const std::vector<KindLine>& lines);

  std::vector<KindLine> truth_;
  TruthTopology truth_topology_;
  RangeConfig range_;
  MapScore score_;
  StabilityMeter stability_;
  AveragePrecisionMeter average_precision_;
  TrustMeter trust_;
  ProfileMeter profile_;
  StyleScore styles_;
  TopologyScore topology_;
  TopLl top_ll_;
  SteadinessMeter steadiness_;
  LaneMetresMeter lane_metres_;
};

}  // namespace laneloom::evaluation
