#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace laneloom::simulation {

/// Random numbers from a seed, the same with every standard library and on every host: only exact arithmetic
/// is done on the engine's output.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// A uniform number in [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  bool chance(double probability) { return uniform() < probability; }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }

  /// A number of mean 0 and standard deviation 1. It is nearly normal, and never beyond 6 (the sum of twelve
  /// uniform numbers).
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

 private:
  std::mt19937_64 engine_;
};

/// A value of standard deviation 1 that wanders (Ornstein-Uhlenbeck).
class Wander {
 public:
  explicit Wander(Random& random) : value_(random.normal()) {}
  double value() const { return value_; }
  /// `memory_s` is the time after which about a third of the value is left; 0 forgets at once.
  void step(double dt_s, double memory_s, Random& random) {
    const double kept = memory_s > 0.0 ? std::fmax(0.0, 1.0 - dt_s / memory_s) : 0.0;
    value_ = kept * value_ + std::sqrt(1.0 - kept * kept) * random.normal();
  }

 private:
  double value_;
};

/// A state that is on for a share of the time, and stays on for a while.
class Switch {
 public:
  Switch(double share, Random& random) : on_(random.chance(share)) {}
  bool on() const { return on_; }
  /// `dwell_s` is the mean time that it stays on.
  void step(double dt_s, double share, double dwell_s, Random& random) {
    const double off = std::fmin(1.0, dt_s / dwell_s);
    on_ = random.chance(on_ ? 1.0 - off : std::fmin(1.0, off * share / std::fmax(1e-9, 1.0 - share)));
  }

 private:
  bool on_;
};

}  // namespace laneloom::simulation
