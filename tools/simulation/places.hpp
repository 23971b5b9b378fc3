#pragma once

#include <cstdint>

#include "laneloom/types.hpp"

namespace laneloom::simulation {

/// An error of a network at a place that lasts for a whole drive, however often the place is passed.
enum class Trait : std::uint8_t {
  missed,
  poor,
  poor_offset,
  cut,
  duplicated,
  duplicate_side,
  swapped,
  style,
  offset
};

/// The places along one line. A random value of a place depends on the drive's seed, the line and the place
/// alone, so that it is the same from wherever and whenever the place is seen. Arc lengths are in metres;
/// those of a ring may be below 0 or beyond its length.
class Places {
 public:
  /// `line` tells the line from others. A line without length is one place.
  Places(std::uint64_t seed, std::uint64_t line, double length_m, bool ring);

  /// A random value in [0, 1), the same all along a stretch of some 25 m.
  double uniform(Trait trait, double arc_m) const;
  /// Whether the stretch is among a random share of all stretches.
  bool among(double share, Trait trait, double arc_m) const { return uniform(trait, arc_m) < share; }
  /// A random value of standard deviation 1, which changes smoothly, over some 25 m.
  double wave(Trait trait, double arc_m) const;
  /// The end of the stretch of a place.
  double stretch_end_m(double arc_m) const;

 private:
  std::int64_t stretch(double arc_m) const;
  std::uint64_t bits(Trait trait, std::int64_t stretch) const;
  double normal(Trait trait, std::int64_t knot) const;

  std::uint64_t key_;
  std::int64_t count_;  ///< number of stretches
  double step_m_;       ///< length of a stretch
  bool ring_;
};

}  // namespace laneloom::simulation
