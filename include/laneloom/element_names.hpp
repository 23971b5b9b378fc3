#pragma once

#include <array>
#include <cstddef>

#include "laneloom/types.hpp"

/// The enumerators of map elements as words, in the order of their values: in files, and for people.
namespace laneloom {

inline constexpr std::array kTypeNames{"laneline", "roadedge", "stopline"};
inline constexpr std::array kStyleNames{"unknown", "solid", "dashed"};
inline constexpr std::array kStatusNames{"tentative", "confirmed", "inferred"};
inline constexpr std::array kDirectionNames{"unknown", "along", "against"};
inline constexpr std::array kLinkageNames{"shared_boundary", "geometric_alignment", "intersection", "sd_map",
                                          "ego_track"};
inline constexpr std::array kTurnNames{"unknown", "straight", "left", "right", "u_turn"};
inline constexpr std::array kLineageNames{"born", "merged_into", "split_from", "retired"};

inline const char* name(MarkingType type) { return kTypeNames.at(index(type)); }
inline const char* name(MarkingStyle style) { return kStyleNames.at(index(style)); }
inline const char* name(ElementStatus status) { return kStatusNames.at(static_cast<std::size_t>(status)); }
inline const char* name(Lane::Direction direction) {
  return kDirectionNames.at(static_cast<std::size_t>(direction));
}
inline const char* name(Linkage::Kind kind) { return kLinkageNames.at(static_cast<std::size_t>(kind)); }
inline const char* name(Linkage::Turn turn) { return kTurnNames.at(static_cast<std::size_t>(turn)); }
inline const char* name(LineageEvent::Kind kind) { return kLineageNames.at(static_cast<std::size_t>(kind)); }

}  // namespace laneloom
