#pragma once

#include <string>
#include <vector>

#include "laneloom/messages.hpp"

/// The contract of published maps, on which every consumer may rely, and its check.
namespace laneloom::contract {

enum class ContractRule : std::uint8_t {
  finite_numbers,              ///< every number is finite
  valid_geometry,              ///< polylines have at least two points and horizontal extent
  unique_ids,                  ///< no id is 0 or given twice to elements of one kind
  known_ids,                   ///< every id that is referred to is in the map, and not the element's own
  left_is_left,                ///< a lane's left side is left of its right side, in the direction of both
  centered_line,               ///< a lane's centerline lies between its sides
  neighbours_across_boundary,  ///< a lane and its neighbour share the boundary between them, and each names
                               ///< the other
  joined_lanes_meet,  ///< a linkage leads from the end of one lane to the beginning of the other, without a
                      ///< path only where both are one point
  kept_orientation,   ///< a lane's points run one way as long as its id lasts
  told_lineage,       ///< lineage tells of each lane that came or went
  covering_borders,   ///< the borders of a lane cover its centerline on either side, in order
  lanes_apart,  ///< lanes overlap by no more than the deviations of their borders tell, but for 2 m at their
                ///< ends
  stated_evidence,     ///< there is evidence of each lane, linkage and direction that is told
  sound_way,           ///< the own way begins beside the vehicle, has even stations that fit one another, and
                       ///< leads through lanes of the map
  range_in_boundary,   ///< ranges lie within the line that they are a stretch of
  valid_values,        ///< probabilities, deviations and widths are possible
  ascending_sequence,  ///< within a session, sequence numbers neither repeat nor go back
  possible_age,        ///< the age fits the stamp, and grows while nothing new is fused
  stated_reasons       ///< a map that is not OK has reasons, and one that is OK has none
};
const char* name(ContractRule rule);

/// A rule that a map breaks.
struct Violation {
  ContractRule rule = ContractRule::finite_numbers;
  std::string detail;  ///< the element, and the problem with it
};

/// Finds all violations of the contract in `map`. `previous` is the map received before it, or null. Pure;
/// never throws on odd values, which are among what it looks for.
std::vector<Violation> check_contract(const PublishedMap& map, const PublishedMap* previous);

/// Finds the violations of `lanes_apart`. Maps do not always keep this rule yet, so it is not part of the
/// contract.
std::vector<Violation> check_lanes_apart(const LocalMap& map);

/// Number of maps that were published between the two and not received. A loss is counted, but is no
/// violation. 0 across sessions and if the sequence does not ascend.
std::uint64_t missed_maps(const PublishedMap& map, const PublishedMap* previous);

}  // namespace laneloom::contract
