#include "simulation/places.hpp"

#include <algorithm>
#include <cmath>

namespace laneloom::simulation {
namespace {

constexpr double kStretch_m = 25.0;

// SplitMix64 (Steele, Lea and Flood, 2014): neighbouring numbers give unrelated ones.
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31U);
}

double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

}  // namespace

Places::Places(std::uint64_t seed, std::uint64_t line, double length_m, bool ring)
    : key_(mixed(mixed(seed) ^ line)),
      count_(std::max<std::int64_t>(1, std::llround(length_m / kStretch_m))),
      step_m_(length_m > 0.0 ? length_m / static_cast<double>(count_) : kStretch_m),
      ring_(ring) {}

std::int64_t Places::stretch(double arc_m) const {
  return static_cast<std::int64_t>(std::floor(arc_m / step_m_));
}

double Places::stretch_end_m(double arc_m) const { return static_cast<double>(stretch(arc_m) + 1) * step_m_; }

std::uint64_t Places::bits(Trait trait, std::int64_t stretch) const {
  if (ring_) stretch = ((stretch % count_) + count_) % count_;
  return mixed(key_ ^ mixed(static_cast<std::uint64_t>(stretch) * 64U + static_cast<std::uint64_t>(trait)));
}

double Places::uniform(Trait trait, double arc_m) const { return unit(bits(trait, stretch(arc_m))); }

double Places::normal(Trait trait, std::int64_t knot) const {
  std::uint64_t state = bits(trait, knot);
  double sum = -6.0;  // as Random::normal()
  for (int i = 0; i < 12; ++i) sum += unit(state = mixed(state));
  return sum;
}

double Places::wave(Trait trait, double arc_m) const {
  const std::int64_t knot = stretch(arc_m);
  const double to = arc_m / step_m_ - static_cast<double>(knot), from = 1.0 - to;
  return (from * normal(trait, knot) + to * normal(trait, knot + 1)) / std::sqrt(from * from + to * to);
}

}  // namespace laneloom::simulation
