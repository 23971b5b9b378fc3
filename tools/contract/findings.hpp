#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contract/contract.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom {

/// Collects violations while a map is walked.
class Findings {
 public:
  /// Records a violation of `rule` unless `holds`; tells whether it held.
  bool require(bool holds, ContractRule rule, const std::string& detail) {
    if (!holds) violations_.push_back({rule, detail});
    return holds;
  }
  std::vector<Violation> take() { return std::move(violations_); }

 private:
  std::vector<Violation> violations_;
};

/// Two finite points at least, and horizontal extent.
bool is_measurable(const Polyline& line);

/// Whether `line` is measurable. Else it is recorded what is wrong.
bool check_line(const Polyline& line, const std::string& what, Findings& findings);

/// That `range` is a forward or backward stretch of a line of `length_m`.
void check_range(const Stretch& range, double length_m, const std::string& what, Findings& findings);

/// That a probability is in 0..1, or -1 for "not estimated".
void check_probability(double value, const std::string& what, Findings& findings);

/// The rules about lanes: sides, centerlines, boundaries and neighbours.
void check_lanes(const LocalMap& map, Findings& findings);

}  // namespace laneloom
