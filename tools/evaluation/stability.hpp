#pragma once

#include <map>
#include <optional>
#include <vector>

#include "base/distribution.hpp"
#include "evaluation/evaluation.hpp"

/// The steadiness of a map from frame to frame. The paper claims stability without measuring it; these are
/// the project's definitions.
///
/// A truth line is told by its longest piece in range; it is right where that piece has a true positive.
/// - Jitter: where a truth line is right in two consecutive frames, the lateral distance from the later true
///   positive, taken every metre, to the earlier one, both in the map frame and within their ranges. Places
///   that only one of them covers do not count.
/// - Id switch: a truth line's true positive has another id than the one it last had, also across frames
///   where the line was wrong (as in CLEAR MOT, Bernardin and Stiefelhagen 2008). Lines without ids have
///   none.
/// - Length driven past: of every truth line, the stretch that was in range in any frame, to the metre.
/// - Flicker: of the frames in which a truth line is in range and was right the frame before, the share in
///   which it is wrong.
namespace laneloom::evaluation {

/// How steady the published lines of one kind are over a drive.
struct Stability {
  Distribution jitter_m;
  std::size_t id_switches = 0;
  bool has_ids = false;
  double driven_past_m = 0.0;
  std::size_t was_right = 0;  ///< truth lines in range that were right the frame before, over all frames
  std::size_t lost = 0;       ///< number of these lines that are not right in the present frame

  double id_switches_per_km() const;
  double flicker() const;  ///< 0..1
};

/// Not thread-safe.
class StabilityMeter {
 public:
  StabilityMeter(const std::vector<KindLine>& truth, const RangeConfig& range);
  /// Adds the next frame, which was compared with the truth; `predictions` are the lines that were compared.
  void add(const FrameComparison& frame, const std::vector<KindLine>& predictions);
  /// The mean jitter of all markings, frame by frame. None: no marking was right in two frames in a row.
  const std::vector<std::optional<double>>& jitter_over_time_m() const { return jitter_over_time_m_; }
  const Stability& of(LineKind kind) const { return by_kind_[index(kind)]; }

 private:
  struct TruthState {
    Polyline stations;  ///< middles of stretches of equal length that were not yet in range
    double stretch_m = 0.0;
    ElementId id = kNoElement;          ///< of the last true positive
    std::optional<Polyline> published;  ///< the frame before's true positive, map frame
  };
  void add_driven_past(const Eigen::Isometry3d& T_body_map, TruthState& state, Stability& stability) const;

  RangeConfig range_;
  std::vector<LineKind> kinds_;
  std::vector<TruthState> truths_;
  std::array<Stability, kLineKindCount> by_kind_;
  std::vector<std::optional<double>> jitter_over_time_m_;
};

}  // namespace laneloom::evaluation
