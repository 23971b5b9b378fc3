#include "mapping/geometry/reproducible.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace laneloom::geometry::reproducible {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ln 2 and pi / 2 in two parts. The first one has bits of zero at its end: its products with small integers
// are exact.
constexpr double kLn2 = 6.93147180369123816490e-01, kLn2Rest = 1.90821492927058770002e-10;
constexpr double kQuarter = 1.57079632673412561417e+00, kQuarterRest = 6.07710050650619224932e-11;

/// c[0] + c[1] x + c[2] x^2 + ...
constexpr double polynomial(double x, std::span<const double> coefficients) {
  double sum = 0.0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) sum = sum * x + *c;
  return sum;
}

/// The sine of an angle of at most pi / 4.
double sine(double x) {
  constexpr std::array kC{-1.66666666666666324348e-01, 8.33333333332248946124e-03,
                          -1.98412698298579493134e-04, 2.75573137070700676789e-06,
                          -2.50507602534068634195e-08, 1.58969099521155010221e-10};
  const double z = x * x;
  return x + x * z * polynomial(z, kC);
}

/// The cosine of an angle of at most pi / 4.
double cosine(double x) {
  constexpr std::array kC{4.16666666666666019037e-02, -1.38888888888741095749e-03,
                          2.48015872894767294178e-05, -2.75573143513906633035e-07,
                          2.08757232129817482790e-09, -1.13596475577881948265e-11};
  const double z = x * x, half = 0.5 * z, most = 1.0 - half;
  return most + (((1.0 - most) - half) + z * z * polynomial(z, kC));
}

/// The number of quarter turns that lie nearest to an angle, and what is left of it.
struct Reduced {
  int quarters;
  double rest;
};
Reduced reduced(double x) {
  const double quarters = std::floor(x / (kQuarter + kQuarterRest) + 0.5);
  return {static_cast<int>(quarters), (x - quarters * kQuarter) - quarters * kQuarterRest};
}

double sine_of_quarters(int quarters, double rest) {
  const double value = quarters % 2 == 0 ? sine(rest) : cosine(rest);
  return (quarters & 2) == 0 ? value : -value;
}

/// The angle whose tangent is `x`, from 0 to 1.
double arctangent(double x) {
  constexpr std::array kC{
      3.33333333333329318027e-01,  -1.99999999998764832476e-01, 1.42857142725034663711e-01,
      -1.11111104054623557880e-01, 9.09088713343650656196e-02,  -7.69187620504482999495e-02,
      6.66107313738753120669e-02,  -5.83357013379057348645e-02, 4.97687799461593236017e-02,
      -3.65315727442169155270e-02, 1.62858201153657823623e-02};
  struct Anchor {
    double below, tangent, angle, rest;  // the angle in two parts
  };
  constexpr std::array kAnchors{
      Anchor{0.4375, 0.0, 0.0, 0.0},
      Anchor{0.6875, 0.5, 4.63647609000806093515e-01, 2.26987774529616870924e-17},
      Anchor{kInfinity, 1.0, 7.85398163397448278999e-01, 3.06161699786838301793e-17}};
  const Anchor* anchor = kAnchors.data();
  while (x >= anchor->below) ++anchor;
  const double t = (x - anchor->tangent) / (1.0 + anchor->tangent * x), z = t * t;
  return anchor->angle - ((t * z * polynomial(z, kC) - anchor->rest) - t);
}

}  // namespace

double exp(double x) {
  constexpr std::array kC{1.66666666666666019037e-01, -2.77777777770155933842e-03, 6.61375632143793436117e-05,
                          -1.65339022054652515390e-06, 4.13813679705723846039e-08};
  constexpr double kLargest = 709.782712893383973096, kSmallest = -745.133219101941108420;
  if (std::isnan(x)) return x;
  if (x > kLargest) return kInfinity;
  if (x < kSmallest) return 0.0;
  const double power = std::floor(x / (kLn2 + kLn2Rest) + 0.5);
  const double high = x - power * kLn2, low = power * kLn2Rest, rest = high - low, z = rest * rest;
  const double c = rest - z * polynomial(z, kC);
  return std::ldexp(1.0 - ((low - rest * c / (2.0 - c)) - high), static_cast<int>(power));
}

double log(double x) {
  constexpr std::array kC{6.666666666666735130e-01, 3.999999999940941908e-01, 2.857142874366239149e-01,
                          2.222219843214978396e-01, 1.818357216161805012e-01, 1.531383769920937332e-01,
                          1.479819860511658591e-01};
  if (x < 0.0) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0.0) return -kInfinity;
  if (std::isnan(x) || x == kInfinity) return x;
  int power = 0;
  double fraction = std::frexp(x, &power);  // from 0.5 to 1
  if (fraction < std::numbers::sqrt2 / 2.0) {
    fraction *= 2.0;
    --power;
  }
  const double f = fraction - 1.0, s = f / (2.0 + f), z = s * s, half = 0.5 * f * f, k = power;
  const double rest = z * polynomial(z, kC);
  return k * kLn2 - ((half - (s * (half + rest) + k * kLn2Rest)) - f);
}

double sin(double x) {
  const auto [quarters, rest] = reduced(x);
  return sine_of_quarters(quarters, rest);
}

double cos(double x) {
  const auto [quarters, rest] = reduced(x);
  return sine_of_quarters(quarters + 1, rest);
}

double atan2(double y, double x) {
  const double across = std::abs(y), along = std::abs(x);
  if (across == 0.0 && along == 0.0) return std::signbit(x) ? std::copysign(std::numbers::pi, y) : y;
  constexpr double kQuarterTurn = std::numbers::pi / 2.0;
  double angle = across <= along ? arctangent(across / along) : kQuarterTurn - arctangent(along / across);
  if (x < 0.0) angle = std::numbers::pi - angle;
  return std::copysign(angle, y);
}

}  // namespace laneloom::geometry::reproducible
