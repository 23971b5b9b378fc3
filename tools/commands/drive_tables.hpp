#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "drive/drive_score.hpp"

namespace laneloom::commands {

/// The score of a drive over one road with one seed.
struct DriveResult {
  std::string road;
  std::uint64_t seed = 1;
  drive::DriveScore score;
};

/// A table with a line per drive and one for all, and the places where lanes were left.
std::string drive_table(const std::vector<DriveResult>& results);

/// The same as JSON, with every departure and guess.
nlohmann::json drive_json(const std::vector<DriveResult>& results);

}  // namespace laneloom::commands
