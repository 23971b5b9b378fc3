#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace laneloom {

/// Values with their mean and quantiles, which are 0 if there are no values.
class Distribution {
 public:
  Distribution() = default;
  explicit Distribution(std::vector<double> values) : values_(std::move(values)) {}

  void add(double value) { values_.push_back(value); }
  void add(const Distribution& other) {
    values_.insert(values_.end(), other.values_.begin(), other.values_.end());
  }
  std::size_t count() const { return values_.size(); }
  double mean() const {
    return values_.empty()
               ? 0.0
               : std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
  }
  double root_mean_square() const {
    if (values_.empty()) return 0.0;
    const double squares = std::inner_product(values_.begin(), values_.end(), values_.begin(), 0.0);
    return std::sqrt(squares / static_cast<double>(values_.size()));
  }
  /// The smallest value that at least the `share` (0..1) of all values do not exceed.
  double quantile(double share) const {
    if (values_.empty()) return 0.0;
    std::vector<double> values = values_;
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
  }

 private:
  std::vector<double> values_;
};

}  // namespace laneloom
