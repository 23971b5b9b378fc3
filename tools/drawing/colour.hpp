#pragma once

namespace laneloom::drawing {

/// A colour; every part is 0..1.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
  constexpr Colour faded(double factor) const { return {red, green, blue, alpha * factor}; }
};

}  // namespace laneloom::drawing
