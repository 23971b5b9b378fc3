#pragma once

/// Elementary functions that give the same bits on every processor: they are sums, products and quotients of
/// doubles alone, which IEEE 754 defines to the last bit. (The C library selects its functions by the
/// processor, and their last bits differ.) They are off by less than one unit in the last place. The
/// coefficients are those of fdlibm.
namespace laneloom::geometry::reproducible {

double exp(double x);
/// Not a number below 0; minus infinity at 0.
double log(double x);
/// `x` is an angle of at most some turns, in rad.
double sin(double x);
double cos(double x);
double atan2(double y, double x);

/// The probability of log odds.
inline double probability(double log_odds) { return 1.0 / (1.0 + exp(-log_odds)); }

}  // namespace laneloom::geometry::reproducible
