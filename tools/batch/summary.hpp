#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "batch/run.hpp"

namespace laneloom::batch {

/// A figure over drives.
struct Figure {
  std::string name;        ///< its JSON pointer in the outputs, without the first '/'
  std::size_t drives = 0;  ///< those that have it
  double mean = 0.0;
  double interval = 0.0;  ///< half of the 95 % interval of the mean (Student's t); 0: one drive
  double least = 0.0, most = 0.0;
  std::string least_drive, most_drive;
};

/// All numbers that the outputs have, if they are JSON.
std::vector<Figure> figures_of(const std::vector<Result>& results);

/// One line per drive, then how many there are of each kind, and the figures that the step shows.
std::string table(const Step& step, const std::vector<Result>& results);

/// The same with all figures. Nothing in it depends on when or where the drives were run.
nlohmann::json to_json(const Step& step, const std::vector<Result>& results);

}  // namespace laneloom::batch
