#pragma once

#include <filesystem>
#include <vector>

#include "commands/evaluation_tables.hpp"

namespace laneloom::commands {

/// Draws over_time and over_range, each as .svg and .png, into a folder that is made if need be. They show
/// precision and recall by samples (evaluation/profile.hpp), the lateral error, and over time the jitter,
/// with one colour per name. Throws std::runtime_error naming a file that cannot be written.
void draw_evaluation(const std::vector<NamedEvaluation>& evaluations, const std::filesystem::path& folder);

}  // namespace laneloom::commands
