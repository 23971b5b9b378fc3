#pragma once

#include <string>
#include <vector>

#include "laneloom/messages.hpp"

/// What a consumer may rely on in every published map, and the check of it.
namespace laneloom {

enum class ContractRule : std::uint8_t {
  finite_numbers,              ///< every number is finite
  valid_geometry,              ///< polylines have at least two points and horizontal extent
  unique_ids,                  ///< no id is 0 or given twice to elements of one kind
  known_ids,                   ///< every id that is referred to is in the map, and not the element's own
  left_is_left,                ///< a lane's left side is left of its right side, in the direction of both
  centered_line,               ///< a lane's centerline lies between its sides
  neighbours_across_boundary,  ///< a lane and its neighbour share the boundary between them, and each names
                               ///< the other
  range_in_boundary,           ///< ranges lie within the line that they are a stretch of
  valid_values,                ///< probabilities, confidences, deviations and widths are possible
  ascending_sequence,          ///< within a session, sequence numbers neither repeat nor go back
  possible_age,                ///< the age fits the stamp, and grows while nothing new is fused
  stated_reasons               ///< a map that is not OK says why, one that is OK has nothing to say
};
const char* name(ContractRule rule);

struct Violation {
  ContractRule rule = ContractRule::finite_numbers;
  std::string detail;  ///< which element, and what is wrong with it
};

/// Everything in `map` that a consumer must never see; empty if all is well. `previous` is the map received
/// before it, or null. Pure; never throws on odd values (they are what it looks for).
std::vector<Violation> check_contract(const PublishedMap& map, const PublishedMap* previous);

/// Maps that were published between the two and not received: a loss to be counted, not a violation.
/// 0 across sessions and where the sequence does not ascend.
std::uint64_t missed_maps(const PublishedMap& map, const PublishedMap* previous);

}  // namespace laneloom
