#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/later.hpp"
#include "evaluation/map_evaluation.hpp"

/// Ratings as text and as JSON. In a text, a dash stands for a value that cannot be told, and shares are per
/// cent; in JSON it is null, and shares are 0..1. The table of what there is none of is empty.
namespace laneloom::commands {

using NamedScore = std::pair<std::string, evaluation::MapScore>;
using NamedEvaluation = std::pair<std::string, evaluation::MapEvaluation>;

/// One line per kind and score: precision, recall, F1, ACD (metres) and the counts.
std::string score_table(const std::vector<NamedScore>& scores);
nlohmann::json score_json(const std::vector<NamedScore>& scores);

/// The measures beyond those: stability, average precision, trust, styles, linkages, stoplines, what a
/// planner takes.
std::string evaluation_tables(const std::vector<NamedEvaluation>& evaluations);
nlohmann::json evaluation_json(const std::vector<NamedEvaluation>& evaluations);

/// The median and the 90th percentile of the lateral errors of each marking type by distance. JSON has them
/// under each name's "lateral_error", and the figures over range under its "range".
std::string profile_table(const std::vector<NamedEvaluation>& evaluations);
nlohmann::json profile_json(const std::vector<NamedEvaluation>& evaluations);

/// Where the metres of published lanes lie.
std::string lane_metres_table(const evaluation::LaneMetres& metres);
nlohmann::json lane_metres_json(const evaluation::LaneMetres& metres);

/// What a planner takes from the maps of a drive.
std::string steadiness_table(const evaluation::Steadiness& steadiness);
nlohmann::json steadiness_json(const evaluation::Steadiness& steadiness);

/// Single detections and maps side by side, by what is seen later.
std::string later_table(const evaluation::LaterMeter& meter);
nlohmann::json later_json(const evaluation::LaterMeter& meter);

/// Draws over_time and over_range, each as .svg and .png, into a folder that is made if need be. They show
/// precision and recall by samples (evaluation/profile.hpp), the lateral error, and over time the jitter,
/// with one colour per name. Throws std::runtime_error naming a file that cannot be written.
void draw_evaluation(const std::vector<NamedEvaluation>& evaluations, const std::filesystem::path& folder);

}  // namespace laneloom::commands
