#pragma once

#include <array>
#include <cstddef>

namespace laneloom::support {

/// The 97.5 % quantile of Student's t; from 31 degrees of freedom on, to 0.2 %.
inline double t_quantile(std::size_t degrees_of_freedom) {
  constexpr std::array kQuantiles{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                                  2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
                                  2.080,  2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042};
  if (degrees_of_freedom <= kQuantiles.size()) return kQuantiles.at(degrees_of_freedom - 1);
  return 1.960 + 2.4 / static_cast<double>(degrees_of_freedom);
}

}  // namespace laneloom::support
