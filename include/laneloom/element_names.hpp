#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "laneloom/types.hpp"

/// Words for the enumerators of map elements, in the order of their values. Files and people read them.
namespace laneloom {

inline constexpr std::array kTypeNames{"laneline", "roadedge", "stopline"};
inline constexpr std::array kStyleNames{"unknown", "solid", "dashed"};
inline constexpr std::array kStatusNames{"tentative", "confirmed", "inferred"};
inline constexpr std::array kDirectionNames{"unknown", "along", "against", "both"};
inline constexpr std::array kUseNames{"unknown", "lane", "shoulder", "parking", "cycle"};
inline constexpr std::array kLinkageNames{"shared_boundary", "geometric_alignment", "intersection",
                                          "sd_map",          "ego_track",           "traffic"};
inline constexpr std::array kTurnNames{"unknown", "straight", "left", "right", "u_turn"};
inline constexpr std::array kLineageNames{"born", "merged_into", "split_from", "retired"};
inline constexpr std::array kLineageElementNames{"boundary", "stopline", "lane"};

/// The word for a type of marking.
inline const char* name(MarkingType type) { return kTypeNames.at(index(type)); }
/// The word for a style of paint.
inline const char* name(MarkingStyle style) { return kStyleNames.at(index(style)); }
/// The word for an element's status.
inline const char* name(ElementStatus status) { return kStatusNames.at(static_cast<std::size_t>(status)); }
/// The word for the direction of traffic in a lane.
inline const char* name(Lane::Direction direction) {
  return kDirectionNames.at(static_cast<std::size_t>(direction));
}
/// The word for what a lane is for.
inline const char* name(Lane::Use use) { return kUseNames.at(static_cast<std::size_t>(use)); }
/// The words for the kinds of evidence in a set.
inline std::vector<const char*> names(Evidence evidence) {
  static constexpr std::array kNames{"markings", "edges", "ego_path", "traffic", "sd_map"};
  std::vector<const char*> words;
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (overlap(evidence, kEvidenceKinds.at(i))) words.push_back(kNames.at(i));
  return words;
}
/// The word for the way in which a linkage became known.
inline const char* name(Linkage::Kind kind) { return kLinkageNames.at(static_cast<std::size_t>(kind)); }
/// The word for a turn.
inline const char* name(Linkage::Turn turn) { return kTurnNames.at(static_cast<std::size_t>(turn)); }
/// The word for an event in an id's life.
inline const char* name(LineageEvent::Kind kind) { return kLineageNames.at(static_cast<std::size_t>(kind)); }

/// The word for the kind of element that an event happened to.
inline const char* name(LineageEvent::Element element) {
  return kLineageElementNames.at(static_cast<std::size_t>(element));
}

}  // namespace laneloom
