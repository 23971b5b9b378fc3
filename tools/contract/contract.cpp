#include "contract/contract.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "contract/findings.hpp"

namespace laneloom::contract {
namespace {

constexpr double kMinLength_m = 0.01;
constexpr double kRangeTolerance_m = 0.05;

bool is_finite(const Polyline& line) {
  return std::all_of(line.begin(), line.end(), [](const Point& p) { return p.allFinite(); });
}

void check_styles(const Marking& marking, const std::string& what, Findings& findings) {
  const double length_m = length(marking.points);
  double covered_m = 0.0;
  for (const StyleRange& style : marking.styles) {
    check_range(style.range, length_m, what + " style", findings);
    findings.require(std::abs(style.range.from_m - covered_m) <= kRangeTolerance_m,
                     ContractRule::range_in_boundary, what + " styles leave a gap or overlap");
    covered_m = style.range.to_m;
  }
  findings.require(marking.styles.empty() || std::abs(covered_m - length_m) <= kRangeTolerance_m,
                   ContractRule::range_in_boundary, what + " styles do not reach its end");
}

void check_marking(const Marking& marking, const char* kind, Findings& findings) {
  const std::string what = label(kind, marking.id);
  check_probability(marking.existence_probability, what, findings);
  const auto& stddev = marking.lateral_stddev_m;
  findings.require(stddev.empty() || stddev.size() == marking.points.size(), ContractRule::valid_values,
                   what + " has deviations for another number of points");
  findings.require(
      std::all_of(stddev.begin(), stddev.end(), [](double s) { return std::isfinite(s) && s >= 0.0; }),
      ContractRule::valid_values, what + " has an impossible deviation");
  if (check_line(marking.points, what, findings)) check_styles(marking, what, findings);
}

void check_id(ElementId id, const char* kind, std::set<ElementId>& seen, Findings& findings) {
  findings.require(id != kNoElement && seen.insert(id).second, ContractRule::unique_ids,
                   label(kind, id) + (id == kNoElement ? " is no id" : " occurs twice"));
}

void check_ids(const LocalMap& map, Findings& findings) {
  std::set<ElementId> instances, markings, lanes;
  for (const Marking& m : map.markings) check_id(m.id, "instance", instances, findings);
  for (const Marking& m : map.boundaries) check_id(m.id, "boundary", markings, findings);
  for (const Stopline& s : map.stoplines) check_id(s.marking.id, "stopline", markings, findings);
  for (const Lane& l : map.lanes) check_id(l.id, "lane", lanes, findings);

  for (const Stopline& stopline : map.stoplines)
    for (const ElementId lane : stopline.lanes)
      findings.require(lanes.contains(lane), ContractRule::known_ids,
                       label("stopline", stopline.marking.id) + " ends unknown " + label("lane", lane));
  for (const Linkage& linkage : map.linkages) {
    const std::string what = "linkage " + std::to_string(linkage.from) + " -> " + std::to_string(linkage.to);
    findings.require(lanes.contains(linkage.from) && lanes.contains(linkage.to), ContractRule::known_ids,
                     what + " joins an unknown lane");
    findings.require(linkage.from != linkage.to, ContractRule::known_ids, what + " joins a lane to itself");
  }
}

void check_markings(const LocalMap& map, Findings& findings) {
  for (const Marking& marking : map.markings) check_marking(marking, "instance", findings);
  for (const Marking& marking : map.boundaries) {
    check_marking(marking, "boundary", findings);
    findings.require(marking.type != MarkingType::stopline, ContractRule::valid_values,
                     label("boundary", marking.id) + " is a stopline");
  }
  for (const Stopline& stopline : map.stoplines) {
    check_marking(stopline.marking, "stopline", findings);
    findings.require(stopline.heading.allFinite(), ContractRule::finite_numbers,
                     label("stopline", stopline.marking.id) + " has a heading that is not finite");
  }
}

void check_linkages(const LocalMap& map, Findings& findings) {
  for (const Linkage& linkage : map.linkages) {
    const std::string what = "linkage " + std::to_string(linkage.from) + " -> " + std::to_string(linkage.to);
    findings.require(linkage.probability >= 0.0 && linkage.probability <= 1.0, ContractRule::valid_values,
                     what + " has probability " + std::to_string(linkage.probability));
    findings.require(linkage.evidence != Evidence::none, ContractRule::stated_evidence,
                     what + " has no evidence");
    if (!linkage.path.empty()) check_line(linkage.path, what + " path", findings);
  }
}

void check_header(const PublishedMap& map, Findings& findings) {
  findings.require(map.map.T_map_body.matrix().allFinite(), ContractRule::finite_numbers,
                   "the pose is not finite");
  const bool fused = map.map.stamp_ns != 0;
  findings.require(fused ? std::isfinite(map.age_s) && map.age_s >= 0.0 : map.age_s == -1.0,
                   ContractRule::possible_age,
                   "age " + std::to_string(map.age_s) + " s with stamp " + std::to_string(map.map.stamp_ns));
  findings.require((map.state == MapState::ok) == map.reasons.empty(), ContractRule::stated_reasons,
                   map.reasons.empty() ? "not OK, without a reason" : "OK, with a reason");
}

void check_succession(const PublishedMap& map, const PublishedMap& previous, Findings& findings) {
  if (map.session_id != previous.session_id) return;
  findings.require(
      map.sequence > previous.sequence, ContractRule::ascending_sequence,
      "sequence " + std::to_string(map.sequence) + " after " + std::to_string(previous.sequence));
  // The stamp also stays if a frame of a slower source was fused. The frames that a missed map fused are not
  // known.
  const bool nothing_new = map.map.stamp_ns == previous.map.stamp_ns && map.map.stamp_ns != 0 &&
                           map.fused_frames.empty() && map.sequence == previous.sequence + 1;
  findings.require(!nothing_new || map.age_s >= previous.age_s, ContractRule::possible_age,
                   "age fell from " + std::to_string(previous.age_s) + " s to " + std::to_string(map.age_s) +
                       " s though nothing was fused");
  if (map.map_id != previous.map_id) return;
  check_orientations(map.map, previous.map, findings);
  if (map.sequence == previous.sequence + 1) check_lineage(map.map, previous.map, findings);
}

}  // namespace

const char* name(ContractRule rule) {
  switch (rule) {
    case ContractRule::finite_numbers:
      return "finite_numbers";
    case ContractRule::valid_geometry:
      return "valid_geometry";
    case ContractRule::unique_ids:
      return "unique_ids";
    case ContractRule::known_ids:
      return "known_ids";
    case ContractRule::left_is_left:
      return "left_is_left";
    case ContractRule::centered_line:
      return "centered_line";
    case ContractRule::neighbours_across_boundary:
      return "neighbours_across_boundary";
    case ContractRule::joined_lanes_meet:
      return "joined_lanes_meet";
    case ContractRule::kept_orientation:
      return "kept_orientation";
    case ContractRule::told_lineage:
      return "told_lineage";
    case ContractRule::covering_borders:
      return "covering_borders";
    case ContractRule::lanes_apart:
      return "lanes_apart";
    case ContractRule::stated_evidence:
      return "stated_evidence";
    case ContractRule::sound_way:
      return "sound_way";
    case ContractRule::range_in_boundary:
      return "range_in_boundary";
    case ContractRule::valid_values:
      return "valid_values";
    case ContractRule::ascending_sequence:
      return "ascending_sequence";
    case ContractRule::possible_age:
      return "possible_age";
    case ContractRule::stated_reasons:
      return "stated_reasons";
  }
  return "unknown";
}

bool is_measurable(const Polyline& line) {
  return line.size() >= 2 && is_finite(line) && length(line) > kMinLength_m;
}

bool check_line(const Polyline& line, const std::string& what, Findings& findings) {
  return findings.require(is_finite(line), ContractRule::finite_numbers,
                          what + " has a point that is not finite") &&
         findings.require(is_measurable(line), ContractRule::valid_geometry,
                          what + " has no length (" + std::to_string(line.size()) + " points)");
}

void check_range(const Stretch& range, double length_m, const std::string& what, Findings& findings) {
  const auto [low_m, high_m] = std::minmax(range.from_m, range.to_m);
  // Written so that a NaN fails.
  findings.require(low_m >= -kRangeTolerance_m && high_m <= length_m + kRangeTolerance_m && high_m > low_m,
                   ContractRule::range_in_boundary,
                   what + " range " + std::to_string(range.from_m) + ".." + std::to_string(range.to_m) +
                       " m of " + std::to_string(length_m) + " m");
}

void check_probability(double value, const std::string& what, Findings& findings) {
  findings.require(value == -1.0 || (value >= 0.0 && value <= 1.0), ContractRule::valid_values,
                   what + " has probability " + std::to_string(value));
}

std::vector<Violation> check_contract(const PublishedMap& map, const PublishedMap* previous) {
  Findings findings;
  check_header(map, findings);
  check_ids(map.map, findings);
  check_markings(map.map, findings);
  check_lanes(map.map, findings);
  check_linkages(map.map, findings);
  check_joints(map.map, findings);
  check_way(map.map, findings);
  check_driven_paths(map.map, findings);
  if (previous != nullptr) check_succession(map, *previous, findings);
  return findings.take();
}

std::vector<Violation> check_lanes_apart(const LocalMap& map) {
  Findings findings;
  check_space(map, findings);
  return findings.take();
}

std::uint64_t missed_maps(const PublishedMap& map, const PublishedMap* previous) {
  if (previous == nullptr || map.session_id != previous->session_id || map.sequence <= previous->sequence)
    return 0;
  return map.sequence - previous->sequence - 1;
}

}  // namespace laneloom::contract
