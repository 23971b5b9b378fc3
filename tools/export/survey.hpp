#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "export/drive_lines.hpp"
#include "export/line_archive.hpp"
#include "laneloom/types.hpp"

namespace laneloom::exports {

/// The lines of a road, and the ways that vehicles drove on it, in the frame of the first drive.
struct SurveyedRoad {
  std::vector<Marking> markings;  ///< lanelines, roadedges and stoplines, with ids from 1 on
  std::vector<Eigen::Isometry3d>
      poses;  ///< T_map_body, about every 2 m along each drive, one drive after another
};

/// Makes one road of one drive or many. The loops of each drive are closed (loops.hpp), and each drive is
/// moved onto the road of those before (align.hpp). Lines of several passes are made one (line_archive.hpp).
/// Roadedges where a vehicle drove are left out (driven_over.hpp). Memory grows with the road, not with the
/// drives. Not thread-safe.
class Survey {
 public:
  /// The way in which a drive was moved.
  struct Offset {
    double mean_m = 0.0, greatest_m = 0.0;  ///< horizontal, over the drive
    double greatest_deg = 0.0;
    double loops_m = 0.0;    ///< horizontal, greatest: how far it was bent before, to close its loops
    double met_share = 0.0;  ///< the share of its lines that lie on lines of earlier drives
  };

  /// Adds the next drive. Changes are told in the order in which drives are added.
  Offset add(DriveLines drive);
  SurveyedRoad road() const;
  /// The places that the drives do not agree on (line_archive.hpp).
  std::vector<Change> changes() const { return archive_.changes(); }

 private:
  void keep_way(const std::vector<Eigen::Isometry3d>& poses);

  LineArchive archive_;
  std::vector<Eigen::Isometry3d> poses_;
  std::map<std::array<int, 3>, int> ways_;  ///< drives that kept a pose, by place and heading
  std::uint64_t passes_ = 0;
};

}  // namespace laneloom::exports
