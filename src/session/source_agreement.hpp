#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::session {

/// A source whose lines lie beside those of another one.
struct Disagreement {
  std::string source;  ///< the one that came later; it is not fused meanwhile
  std::string other;
  double beside_m = 0.0;  ///< by how much its lines lie to the left of the other one's
};

/// Tells which sources see the same lines at other places than a source that was there before them. Each of
/// them may be right, but a map of both has every line twice. Frames are compared with the newest one of the
/// other source, by the poses of both. Detections that the mapper drops for their confidence tell nothing.
class SourceAgreement {
 public:
  explicit SourceAgreement(const MapperConfig& config)
      : fusion_(config.fusion), min_confidence_(config.preprocess.min_confidence) {}

  /// Whether a frame of that pose may be fused. It may not while its source disagrees. A source of which
  /// nothing arrives for 10 s is forgotten: nobody disagrees with it any more. A shorter pause changes
  /// nothing.
  bool may_fuse(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, std::int64_t arrival_ns);
  /// The sources that disagree.
  std::vector<Disagreement> disagreements() const;
  /// Forgets all frames: the poses that they are compared by are no longer continuous. Who was there first,
  /// and who disagrees, stays known.
  void forget();

 private:
  /// The contradiction of two sources before they are compared. The first comparison decides, so that no line
  /// is born twice. From then on, what four frames in a row say does.
  static constexpr double kAtFirst = 0.4;

  struct Source {
    std::string name;
    std::int64_t arrival_ns = 0;      ///< of its frame that was judged last
    std::int64_t stamp_ns = 0;        ///< of its newest frame
    std::vector<Marking> lines;       ///< of that frame, map frame
    double stddev_m = 0.0;            ///< lateral, of these
    double contradiction = kAtFirst;  ///< share of its frames that contradict the other source, faded
    std::string other;                ///< the source that it was compared with last
    double beside_m = 0.0;            ///< of that one, see Disagreement
    bool disagrees() const { return contradiction > 0.5; }
  };
  void forget_silent(std::int64_t arrival_ns);
  DetectionFrame trusted(const DetectionFrame& frame) const;
  void compare(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, Source& source) const;
  double stddev_m(const DetectionFrame& frame) const;

  FusionConfig fusion_;
  double min_confidence_;        ///< of detections that are compared
  std::vector<Source> sources_;  ///< in the order in which they came
};

}  // namespace laneloom::session
