#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundary_pairs.hpp"
#include "mapping/cross_sections.hpp"

/// Lanes on roads without lines, ours: where a road is wide enough for two, the boundary between them is
/// inferred.
namespace laneloom {

/// A stretch of road that is two lanes side by side.
struct Division {
  BoundaryPair pair;                      ///< that it lies between
  Marking divider;                        ///< inferred
  std::vector<CrossSection> left, right;  ///< of the two lanes; the divider has a point for each
};

/// A divider that was published, for recognising it.
struct KnownDivider {
  ElementId id = kNoElement;
  std::int64_t first_seen_ns = 0;
  Polyline points;
  std::uint64_t last_frame = 0;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, first_seen_ns, points, last_frame);
  }
};

/// Where confirmed boundaries, one of them at least an edge or a line along one, leave room for two lanes,
/// and no lane, edge or confirmed line lies between them. The divider continues a line that begins or ends
/// there; else it lies in the middle. What lies between roads with lines is none. Without ids.
std::vector<Division> divide_unmarked(const std::vector<BoundaryPair>& pairs, const std::vector<Lane>& lanes,
                                      const std::vector<LaneBoundary>& boundaries,
                                      const std::vector<MeasuredPolyline>& measured,
                                      const LaneConfig& config);

/// Gives every divider the id of the known one that it covers most of, else a new one. What was not seen for
/// a while is forgotten.
void identify_dividers(std::uint64_t frame, std::int64_t stamp_ns, const LaneConfig& config,
                       std::vector<Division>& divisions, std::vector<KnownDivider>& known,
                       ElementId& next_id);

/// Adds the dividers to the boundaries, which stay in the order of their ids, and to what is measured of
/// them, and the lanes beside them to the lanes.
void add_divisions(const std::vector<Division>& divisions, std::vector<LaneBoundary>& boundaries,
                   std::vector<MeasuredPolyline>& measured, std::vector<Lane>& lanes);

}  // namespace laneloom
