#pragma once

#include "simulation/road.hpp"

/// Made-up roads whose carriageways lie apart.
namespace laneloom::simulation {

/// The shape of a ramp that turns off from the road.
struct Ramp {
  double radius_m = 300.0;
  double turn_deg = 14.0;
  bool driven = false;
};

/// Three lanes one way. A fourth opens on the right at 60 m, and leaves as an exit at 155 m. Solid lines
/// diverge from there.
Road exit_road(double speed_mps, const Ramp& shape = {});

/// The reverse: a ramp joins three lanes, between solid lines that converge.
Road entry_road(double speed_mps, const Ramp& shape = {});

/// Two one-way carriageways with a median between them.
struct DividedRoad {
  int lanes = 2;          ///< each way, divided by dashes
  double median_m = 1.0;  ///< from one carriageway's left border to the other's
  bool kerbs = false;     ///< there are edges at the median; else solid lines
  bool oncoming = true;   ///< else there is no other carriageway
  bool curved = false;
  int driven = 1;  ///< lane that is driven, counted from the median
};
Road divided_road(const DividedRoad& divided, double speed_mps);

/// The road mirrored on the x axis, so that traffic keeps to the other side.
Road mirrored(Road road);

}  // namespace laneloom::simulation
