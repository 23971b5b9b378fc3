#include "mapping/lanes/smooth_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace laneloom::lanes {
namespace {

// Waves shorter than 2 pi times this many steps are taken for noise.
constexpr double kReach = 3.6;
constexpr double kPenalty = kReach * kReach * kReach * kReach * kReach * kReach;
constexpr std::array kThirdDifference{-1.0, 3.0, -3.0, 1.0};
constexpr std::size_t kBand = 3;  // beside the diagonal

/// A symmetric, positive definite matrix with `kBand` diagonals on either side, factorised as L D L'.
class BandMatrix {
 public:
  explicit BandMatrix(const std::vector<double>& weights) : rows_(weights.size()) {
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i][0] = weights[i];
    for (std::size_t i = 0; i + kBand < rows_.size(); ++i)
      for (std::size_t a = 0; a <= kBand; ++a)
        for (std::size_t b = a; b <= kBand; ++b)
          rows_[i + a][b - a] += kPenalty * kThirdDifference[a] * kThirdDifference[b];
    factorise();
  }

  /// Replaces the right side by the solution.
  void solve(Polyline& x) const {
    const std::size_t n = rows_.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 1; k <= std::min(kBand, i); ++k) x[i] -= rows_[i - k][k] * x[i - k];
    for (std::size_t i = n; i-- > 0;) {
      x[i] /= rows_[i][0];
      for (std::size_t k = 1; k <= std::min(kBand, n - 1 - i); ++k) x[i] -= rows_[i][k] * x[i + k];
    }
  }

 private:
  void factorise() {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (std::size_t m = 0; m <= kBand; ++m) {
        for (std::size_t k = 1; k <= std::min(kBand - m, i); ++k)
          rows_[i][m] -= rows_[i - k][m + k] * rows_[i - k][k] * rows_[i - k][0];
        if (m > 0) rows_[i][m] /= rows_[i][0];
      }
    }
  }

  std::vector<std::array<double, kBand + 1>> rows_;  // the diagonal first, then what stands below it
};

}  // namespace

Polyline smooth_line(const Polyline& points, const std::vector<double>& weights) {
  if (points.size() <= kBand) return points;
  const BandMatrix matrix(weights);
  const Point& origin = points.front();
  Polyline line(points.size()), rest(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) line[i] = weights[i] * (points[i] - origin);
  matrix.solve(line);
  // What is left of bends after the first round comes back in a second one, and hardly any noise.
  for (std::size_t i = 0; i < points.size(); ++i) rest[i] = weights[i] * (points[i] - origin - line[i]);
  matrix.solve(rest);
  for (std::size_t i = 0; i < points.size(); ++i) line[i] += origin + rest[i];
  return line;
}

}  // namespace laneloom::lanes
