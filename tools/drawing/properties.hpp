#pragma once

#include <nlohmann/json.hpp>

#include "laneloom/types.hpp"

/// What is known of elements, as JSON for people: enumerators as words, lengths in metres, times in seconds.
/// What is not known is left out. Numbers are rounded.
namespace laneloom {

/// To a thousandth.
double rounded(double value);

/// `map` is the one that the element is in; with the element's lineage since the map before.
nlohmann::json properties_of(const Marking& marking, const LocalMap& map);
nlohmann::json properties_of(const Stopline& stopline, const LocalMap& map);
nlohmann::json properties_of(const Lane& lane, const LocalMap& map);
nlohmann::json properties_of(const Linkage& linkage);
nlohmann::json properties_of(const LineageEvent& event);

}  // namespace laneloom
