#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "base/distribution.hpp"
#include "evaluation/way.hpp"
#include "simulation/road.hpp"

/// What a planner takes from the maps of a drive, from map to map. It needs no truth.
///
/// The maps of the first 2 s do not count, nor those of the last 4 m, where the vehicle may stand at the end
/// of the road. The inner range is 2 m behind the vehicle to 25 m ahead, and 12 m to each side.
/// - A lane blinks where its id comes or goes, and more than 3 m of it lay in the other map's inner range.
///   So the border of the range makes nothing blink.
/// - A life is short where the id of a lane that blinks away was in maps for less than 0.5 s.
/// - A lane is turned where its centerline leads the other way round than in the map before.
/// - A lane is doubted where its direction is another one than in the map before, or is no longer known.
/// - The way (evaluation/way.hpp) has a reach, joints and kinks. It jumps sideways from one map to the next.
/// - The own lane changes where another id is under the vehicle, no linkage joins the two, and the former
///   one is gone. If it is still there, the vehicle itself changed lanes.
/// - With truth: the way is right where 75 % of the next 10 m of the true way lie within 0.5 m of it.
namespace laneloom::evaluation {

inline constexpr std::array<double, 3> kJumpsAhead_m{0.0, 10.0, 20.0};

/// The counts and distances of a drive, or of several that were added.
struct Steadiness {
  std::size_t maps = 0;
  double duration_s = 0.0, driven_m = 0.0;
  std::size_t lanes = 0;
  std::size_t blinks = 0;
  std::size_t ended = 0;        ///< blinks of lanes that went
  std::size_t short_lives = 0;  ///< number of these that lived for a short time
  std::size_t turned = 0, doubted = 0;
  std::size_t own_wanted = 0;   ///< maps; with truth: those where a true lane is under the vehicle
  std::size_t own_lanes = 0;    ///< number of these in which the vehicle is in a lane or on a path
  std::size_t own_changes = 0;  ///< of the own lane's id
  Distribution reach_m;         ///< of the ways, 30 m at most
  Distribution gap_m, step_m;   ///< at the joints of the ways
  Distribution kink_deg;        ///< the largest one of each way
  std::array<Distribution, kJumpsAhead_m.size()> jump_m;
  std::size_t true_ways = 0;   ///< maps where the truth has a way
  std::size_t right_ways = 0;  ///< number of these in which the map has it

  double per_second(std::size_t events) const;  ///< 0 where no time passed
  double own_changes_per_km() const;            ///< 0 where nothing was driven
  Steadiness& operator+=(const Steadiness& other);
};

/// Tells what each map of a drive adds. It remembers the map before, and the
/// ages of all lanes. Not thread-safe.
class SteadinessSteps {
 public:
  SteadinessSteps() = default;
  explicit SteadinessSteps(const simulation::Road& truth);

  /// What the next map adds. Empty: the map does not count, as it is of the first 2 s, or not later than the
  /// map before.
  std::optional<Steadiness> next(const LocalMap& map);

 private:
  struct LaneBefore {
    Polyline centerline;
    Lane::Direction direction = Lane::Direction::unknown;
  };
  using Lanes = std::map<ElementId, LaneBefore>;

  static Lanes lanes_of(const LocalMap& map);
  void add_blinks(const Lanes& lanes, const Eigen::Isometry3d& T_map_body, Steadiness& added) const;
  void add_changes(const Lanes& lanes, Steadiness& added) const;
  void add_jumps(const Polyline& way, const Eigen::Isometry3d& T_map_body, Steadiness& added) const;
  void add_own_change(const LocalMap& map, const Way& way, const Lanes& lanes, Steadiness& added);
  void add_way(const Way& way, const Eigen::Isometry3d& T_map_body, Steadiness& added) const;

  std::optional<LocalMap> truth_;         ///< its lanes and linkages
  std::optional<std::int64_t> stamp_ns_;  ///< of the map before, or from when on maps count
  bool first_ = true;                     ///< no map counted yet
  // Of the map before:
  Eigen::Isometry3d T_map_body_ = Eigen::Isometry3d::Identity();
  Lanes lanes_;
  Polyline way_;
  ElementId own_lane_ = kNoElement;  ///< the last one; kNoElement: a path was later, or there was none
  std::map<ElementId, std::int64_t> lived_ns_;  ///< by lane
};

/// Not thread-safe.
class SteadinessMeter {
 public:
  SteadinessMeter() = default;
  explicit SteadinessMeter(const simulation::Road& truth) : steps_(truth) {}

  /// Adds the next map. One that is not later than the map before is passed over.
  void add(const LocalMap& map);
  Steadiness steadiness() const;

 private:
  /// What one map added.
  struct Entry {
    Eigen::Vector2d place;  ///< of the vehicle, map frame
    Steadiness added;
  };

  SteadinessSteps steps_;
  std::vector<Entry> entries_;
};

}  // namespace laneloom::evaluation
