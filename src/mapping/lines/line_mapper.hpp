#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/frame_alignment.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/lines/networks.hpp"
#include "mapping/lines/station_update.hpp"
#include "mapping/markings/fused_markings.hpp"
#include "mapping/markings/id_source.hpp"
#include "mapping/markings/preprocess.hpp"
#include "mapping/markings/stage_log.hpp"

namespace laneloom::lines {

/// Our method of fusion. It follows lines over time; each station of a line has its own position and
/// evidence. A value type.
class LineMapper {
 public:
  markings::FusedMarkings fuse(markings::ObservedFrame observed, const geometry::Scene& scene,
                               const MapperConfig& config, markings::IdSource& ids,
                               const markings::StageLog& log);

  /// Whether a frame from this pose tells next to nothing after those before, see Standpoint.
  bool has_seen(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) const;

  /// Whether the last frame lay further away from the map than frames usually do. The map stays behind like
  /// that where odometry is corrected little by little.
  bool is_away() const;

  /// Forgets everything except what was learned of the networks.
  void reset();
  /// Moves all lines, and the places that they were seen from, map frame.
  void move(const Eigen::Isometry3d& motion);

  const std::vector<Line>& lines() const { return lines_; }
  const Networks& networks() const { return networks_; }
  /// Number of lines that there was no room for in the last frame, see keep_within_room().
  std::size_t forgotten() const { return forgotten_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lines_, doubles_, overlaps_, joints_, lasting_error_, away_m_, away_variance_m2_, networks_);
  }

 private:
  Association associated(std::vector<markings::ObservedMarking> markings, Network& network,
                         const FusionConfig& config, Viewpoint& from);
  std::vector<markings::Relative> unite(const FusionConfig& config, bool joins);

  std::vector<Line> lines_;
  markings::PairHistories doubles_;                ///< how lines that lie side by side were seen
  markings::PairHistories overlaps_;               ///< how ends of lines that lie side by side were seen
  markings::PairHistories joints_;                 ///< how ends of lines that lie near each other were seen
  FrameError lasting_error_ = FrameError::Zero();  ///< running mean, see align_frame()
  double away_m_ = 0.0;                            ///< how far the last frame lay from the map
  double away_variance_m2_ = 0.0;                  ///< running mean of its square
  Networks networks_;                              ///< what was learned of the sources
  std::size_t forgotten_ = 0;                      ///< not saved
};

}  // namespace laneloom::lines
