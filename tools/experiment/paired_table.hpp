#pragma once

#include <string>
#include <vector>

#include "experiment/experiment.hpp"

namespace laneloom::experiment {

/// The mean of a number of differences, and half the width of the interval that holds the true mean with a
/// confidence of 95 % (Student's t; the differences are taken to be independent).
struct MeanDifference {
  std::size_t count = 0;
  double mean = 0.0;
  double half_width = 0.0;  ///< 0 of fewer than two differences, which tell no interval
};
MeanDifference mean_difference(const std::vector<double>& differences);

/// A Markdown table with a row per figure: the first configuration's mean over the drives, and how much the
/// others differ from it, drive by drive. The subjects 1 to `configs` of each drive are the configurations,
/// as run() gives them. A drive counts for a figure where both configurations have it. Empty: there are fewer
/// than two configurations, or no drives.
std::string paired_table(const std::vector<DriveResults>& results, std::size_t configs);

}  // namespace laneloom::experiment
