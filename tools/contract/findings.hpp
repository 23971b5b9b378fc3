#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contract/contract.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::contract {

/// Collects violations while a map is walked.
class Findings {
 public:
  /// Records a violation of `rule` unless `holds`. Returns `holds`.
  bool require(bool holds, ContractRule rule, const std::string& detail) {
    if (!holds) violations_.push_back({rule, detail});
    return holds;
  }
  std::vector<Violation> take() { return std::move(violations_); }

 private:
  std::vector<Violation> violations_;
};

/// Whether a line has at least two points, all finite, and horizontal extent.
bool is_measurable(const Polyline& line);

/// Whether `line` is measurable. Records a violation if it is not.
bool check_line(const Polyline& line, const std::string& what, Findings& findings);

/// Names of elements, for people.
inline std::string label(const char* kind, ElementId id) {
  return std::string(kind) + " " + std::to_string(id);
}
inline std::string label(const Lane& lane) { return label("lane", lane.id); }

/// Checks that `range` is a stretch within a line of `length_m`.
void check_range(const Stretch& range, double length_m, const std::string& what, Findings& findings);

/// Checks that a probability is in 0..1, or -1 for "not estimated".
void check_probability(double value, const std::string& what, Findings& findings);

/// Checks the rules about lanes: sides, centerlines, boundaries and neighbours.
void check_lanes(const LocalMap& map, Findings& findings);

/// Checks that linkages lead from lane to lane.
void check_joints(const LocalMap& map, Findings& findings);

/// Checks that lanes do not overlap.
void check_space(const LocalMap& map, Findings& findings);

/// Checks the own way.
void check_way(const LocalMap& map, Findings& findings);

/// Checks the paths that others drove.
void check_driven_paths(const LocalMap& map, Findings& findings);

/// Checks that lanes run as they did in the map before.
void check_orientations(const LocalMap& map, const LocalMap& previous, Findings& findings);

/// Checks that lineage tells of the lanes that came and went since the map before.
void check_lineage(const LocalMap& map, const LocalMap& previous, Findings& findings);

}  // namespace laneloom::contract
