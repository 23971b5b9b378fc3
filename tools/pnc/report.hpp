#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "contract/contract.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/state_names.hpp"
#include "pnc/ego_view.hpp"

namespace laneloom {

/// What the PnC participant made of one map.
struct PncUpdate {
  PublishedMap map;
  EgoView ego;
  std::vector<Violation> violations;
  std::uint64_t missed = 0;  ///< maps that were published since the last one received
};

/// Judges a map that came after `previous` (null for the first).
PncUpdate judge(PublishedMap map, const PublishedMap* previous);

/// For people, several lines.
std::string describe(const PncUpdate& update);
/// The same in one line.
std::string summarise(const PncUpdate& update);
/// For machines: one object; what is unknown is null.
nlohmann::json to_json(const PncUpdate& update);

}  // namespace laneloom
