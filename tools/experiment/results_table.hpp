#pragma once

#include <string>
#include <vector>

#include "experiment/experiment.hpp"

namespace laneloom::experiment {

/// A Markdown table with a row per subject. A dash stands for an undefined value: a share of nothing, or the
/// mean of no values.
std::string results_table(const std::vector<SubjectResult>& results);

}  // namespace laneloom::experiment
