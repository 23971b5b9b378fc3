#pragma once

#include <cstdint>

#include "laneloom/types.hpp"

namespace laneloom {

/// What a network gets wrong at a place for as long as a drive lasts, however often it comes by.
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

/// The places along one line. What is drawn for a place depends on the drive's seed, the line and the place
/// alone, so that it is the same from wherever and whenever it is seen. Arc lengths are in metres; those of a
/// ring may be below 0 or beyond its length.
class Places {
 public:
  /// `line` tells the line from others; a line without length is one place.
  Places(std::uint64_t seed, std::uint64_t line, double length_m, bool ring);

  /// In [0, 1), the same all along a stretch of some 25 m.
  double uniform(Trait trait, double arc_m) const;
  /// Whether the stretch is one of a share of all.
  bool among(double share, Trait trait, double arc_m) const { return uniform(trait, arc_m) < share; }
  /// Standard deviation 1; changes smoothly, over some 25 m.
  double wave(Trait trait, double arc_m) const;
  /// Where the stretch of a place ends.
  double stretch_end_m(double arc_m) const;

 private:
  std::int64_t stretch(double arc_m) const;
  std::uint64_t bits(Trait trait, std::int64_t stretch) const;
  double normal(Trait trait, std::int64_t knot) const;

  std::uint64_t key_;
  std::int64_t count_;  ///< of stretches
  double step_m_;       ///< their length
  bool ring_;
};

}  // namespace laneloom
