#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"

namespace laneloom::exports {

/// Cuts the boundaries of a map, so that each lane between two cuts has one stretch of boundary on each side,
/// which its neighbours share. A gate is a pair of cuts, one on either side of a lane. A cut of a boundary
/// cuts the lanes on both sides of it, and thereby the boundaries beyond. Cuts that would be nearer to each
/// other than 2 m are one. Not thread-safe.
class Gates {
 public:
  struct Cut {
    std::size_t boundary = 0;  ///< index
    double arc_m = 0.0;
  };
  struct Gate {
    std::size_t left = 0, right = 0;  ///< indices of cuts
    bool operator==(const Gate&) const = default;
  };

  /// Makes gates at both ends of every lane. `map` must keep the contract of maps, and outlive this.
  explicit Gates(const LocalMap& map);

  /// Adds a gate to a lane, this far behind its beginning, but not beyond its middle.
  Gate add_within(std::size_t lane, double behind_begin_m);
  /// Cuts boundaries beside lanes where their style changes for at least 5 m.
  void cut_at_styles();
  /// Carries all cuts across the lanes. Gates do not change afterwards.
  void carry_across();

  const std::vector<Gate>& of_lane(std::size_t lane) const { return gates_[lane]; }
  const std::vector<Cut>& cuts() const { return cuts_; }
  /// The cuts on a boundary, by arc length.
  const std::map<double, std::size_t>& on_boundary(std::size_t boundary) const { return order_[boundary]; }
  const MeasuredPolyline& course(std::size_t boundary) const { return courses_[boundary]; }
  Point position(std::size_t cut) const { return courses_[cuts_[cut].boundary].at(cuts_[cut].arc_m); }
  std::size_t boundary_of(std::size_t lane, bool left) const { return sides_[lane][left ? 0 : 1].boundary; }
  bool reversed(std::size_t lane, bool left) const { return sides_[lane][left ? 0 : 1].reversed; }

 private:
  struct SideOfLane {
    std::size_t boundary = 0;
    bool reversed = false;
    double begin_m = 0.0, end_m = 0.0;
  };
  static std::size_t cut_of(const Gate& gate, bool left) { return left ? gate.left : gate.right; }
  double arc(const Gate& gate, bool left) const { return cuts_[cut_of(gate, left)].arc_m; }
  std::size_t create(std::size_t boundary, double arc_m);
  /// The nearest cut within kSnap_m that lies strictly between two arc lengths, or else a new one.
  std::size_t snap(std::size_t boundary, double arc_m, const Stretch& between);
  /// Makes a gate of a lane at a cut on one of its sides. Returns the gate; null: the cut does not lie within
  /// the lane.
  const Gate* pass(std::size_t lane, bool left, std::size_t cut);
  double across(std::size_t lane, bool left, std::size_t cut, const Stretch& between, double share) const;

  const LocalMap& map_;
  std::vector<MeasuredPolyline> courses_;
  std::vector<std::vector<SideOfLane>> sides_;  // per lane: left, right
  std::vector<std::vector<std::pair<std::size_t, bool>>>
      beside_;  // per boundary: lanes, and the side of each on which it lies
  std::vector<Cut> cuts_;
  std::vector<std::map<double, std::size_t>> order_;
  std::vector<std::vector<Gate>> gates_;
  std::deque<std::size_t> to_carry_;
};

}  // namespace laneloom::exports
