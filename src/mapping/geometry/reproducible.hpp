#pragma once

#include <cmath>

/// Functions that give the same bits on every processor. The C library selects its functions for double by
/// the processor, and their last bits differ; for long double it has one each.
namespace laneloom::geometry::reproducible {

inline double exp(double x) { return static_cast<double>(std::exp(static_cast<long double>(x))); }
inline double log(double x) { return static_cast<double>(std::log(static_cast<long double>(x))); }
inline double sin(double x) { return static_cast<double>(std::sin(static_cast<long double>(x))); }
inline double cos(double x) { return static_cast<double>(std::cos(static_cast<long double>(x))); }
inline double atan2(double y, double x) {
  return static_cast<double>(std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
}
/// The probability of log odds.
inline double probability(double log_odds) { return 1.0 / (1.0 + exp(-log_odds)); }

}  // namespace laneloom::geometry::reproducible
