#pragma once

#include <filesystem>
#include <vector>

#include "commands/evaluation_tables.hpp"

namespace laneloom {

/// Draws over_time and over_range, each as .svg and .png, into a folder that is made if need be: precision
/// and recall by samples (evaluation/profile.hpp), lateral error, and over time the jitter; one colour a
/// name. Throws std::runtime_error naming what cannot be written.
void draw_evaluation(const std::vector<NamedEvaluation>& evaluations, const std::filesystem::path& folder);

}  // namespace laneloom
