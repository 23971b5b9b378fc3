#pragma once

#include <cstdint>

#include "simulation/noise_profile.hpp"

namespace laneloom::simulation {

/// A network drawn at random, for which no value was tuned: how far and for how long it errs, what it misses
/// and invents, and how well its confidences tell. The same seed gives the same network on every host. The
/// distributions are in README.md of this folder. Networks of odd seeds do not tell their field of view.
NoiseProfile random_network(std::uint64_t seed);

}  // namespace laneloom::simulation
