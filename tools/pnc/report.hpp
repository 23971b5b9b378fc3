#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "contract/contract.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/state_names.hpp"
#include "pnc/ego_view.hpp"

namespace laneloom::pnc {

/// The findings of the PnC participant on one map.
struct PncUpdate {
  PublishedMap map;
  EgoView ego;
  std::vector<contract::Violation> violations;
  std::uint64_t missed = 0;  ///< number of maps that were published since the one received before
};

/// Judges a map that came after `previous`; null for the first map.
PncUpdate judge(PublishedMap map, const PublishedMap* previous);

/// A text for people, of several lines.
std::string describe(const PncUpdate& update);
/// A text for people, in one line.
std::string summarise(const PncUpdate& update);
/// An object for machines. Unknown values are null.
nlohmann::json to_json(const PncUpdate& update);

}  // namespace laneloom::pnc
