#pragma once

#include <cmath>

/// Functions that give the same bits on every processor. The C library selects its functions for double by
/// the processor, and their last bits differ; for long double it has one each.
namespace laneloom::geometry::reproducible {

inline double exp(double x) { return static_cast<double>(std::exp(static_cast<long double>(x))); }
inline double log(double x) { return static_cast<double>(std::log(static_cast<long double>(x))); }

}  // namespace laneloom::geometry::reproducible
