#pragma once

#include <nlohmann/json.hpp>

#include "laneloom/types.hpp"

/// The properties of elements as JSON for people: enumerators as words, lengths in metres, times in seconds.
/// Unknown properties are left out. Numbers are rounded.
namespace laneloom::drawing {

/// Rounds to a thousandth.
double rounded(double value);

/// `map` holds the element. Its lineage events of the element are properties too.
nlohmann::json properties_of(const Marking& marking, const LocalMap& map);
nlohmann::json properties_of(const Stopline& stopline, const LocalMap& map);
nlohmann::json properties_of(const Lane& lane, const LocalMap& map);
nlohmann::json properties_of(const Linkage& linkage);
nlohmann::json properties_of(const Way& way);
nlohmann::json properties_of(const LineageEvent& event);

}  // namespace laneloom::drawing
