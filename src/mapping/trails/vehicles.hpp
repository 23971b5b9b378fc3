#pragma once

#include <cstddef>

#include "laneloom/objects.hpp"

/// Which objects are vehicles that leave trails.
namespace laneloom::trails {

inline constexpr double kMoving_mps = 1.0;  // a parked vehicle may seem to creep

/// Whether an object is a vehicle, and the tracker is sure of it.
bool is_sure_vehicle(const TrackedObject& object);
/// Whether an object leaves a trail where it moves forwards, as a vehicle or as a cyclist.
bool is_believed(const TrackedObject& object);
bool is_believed_cyclist(const TrackedObject& object);

/// Objects of a message that move and are not known to be no vehicles.
struct MovingObjects {
  std::size_t believed = 0;
  std::size_t without_heading = 0;
  std::size_t doubted = 0;  ///< of unknown kind, or the tracker is not sure of them

  std::size_t useless() const { return without_heading + doubted; }
  /// Whether objects move, and none of them may leave a trail.
  bool leave_no_trail() const { return believed == 0 && useless() > 0; }
  MovingObjects& operator+=(const MovingObjects& others) {
    believed += others.believed;
    without_heading += others.without_heading;
    doubted += others.doubted;
    return *this;
  }
};
MovingObjects moving_objects(const TrackedObjects& objects);

}  // namespace laneloom::trails
