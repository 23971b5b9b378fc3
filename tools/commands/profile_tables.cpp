#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands/evaluation_tables.hpp"
#include "evaluation/figure.hpp"

namespace laneloom::commands {
namespace {

constexpr double kMedian = 0.5;
constexpr double kMost = 0.9;

using Bands = std::array<evaluation::LateralErrors, evaluation::kErrorBands>;

std::string band_name(std::size_t band) {
  const double from_m = static_cast<double>(band) * evaluation::kErrorBand_m;
  return fmt::format("{:g}-{:g}", from_m, from_m + evaluation::kErrorBand_m);
}

bool empty(const Bands& bands) {
  return std::all_of(bands.begin(), bands.end(),
                     [](const evaluation::LateralErrors& errors) { return errors.count() == 0; });
}

nlohmann::json bands_json(const Bands& bands) {
  nlohmann::json json;
  for (std::size_t band = 0; band < evaluation::kErrorBands; ++band) {
    const evaluation::LateralErrors& errors = bands[band];
    nlohmann::json& to = json[band_name(band)];
    to = {{"p50_m", nullptr}, {"p90_m", nullptr}, {"samples", errors.count()}};
    if (errors.count() == 0) continue;
    to["p50_m"] = errors.quantile(kMedian);
    to["p90_m"] = errors.quantile(kMost);
  }
  return json;
}

nlohmann::json bin_json(int bin, const evaluation::SampleScore& score) {
  const auto when = [](std::size_t samples, double value) {
    return evaluation::null_or(evaluation::when(samples > 0, value));
  };
  return {{"from_m", bin * evaluation::kRangeBin_m},
          {"to_m", (bin + 1) * evaluation::kRangeBin_m},
          {"precision", when(score.predictions, score.precision())},
          {"recall", when(score.truths, score.recall())},
          {"lateral_error_m", when(score.right, score.lateral_error_m())},
          {"samples", score.predictions},
          {"truth_samples", score.truths}};
}

}  // namespace

std::string profile_table(const std::vector<NamedEvaluation>& evaluations) {
  std::string table = fmt::format("\n{:<10} {:<6}", "lateral", "");
  for (std::size_t band = 0; band < evaluation::kErrorBands; ++band)
    table += fmt::format(" {:>10} p50 {:>6}", band_name(band) + " m", "p90");
  table += " [m]\n";
  for (const MarkingType type : kMarkingTypes) {
    for (const auto& [who, evaluation] : evaluations) {
      const Bands& bands = evaluation.profile().errors(type);
      if (empty(bands)) continue;
      table += fmt::format("{:<10} {:<6}", name(evaluation::line_kind(type)), who);
      for (const evaluation::LateralErrors& errors : bands)
        table += errors.count() == 0
                     ? fmt::format(" {:>14} {:>6}", "-", "-")
                     : fmt::format(" {:>14.3f} {:>6.3f}", errors.quantile(kMedian), errors.quantile(kMost));
      table += "\n";
    }
  }
  return table;
}

nlohmann::json profile_json(const std::vector<NamedEvaluation>& evaluations) {
  nlohmann::json json;
  for (const auto& [who, evaluation] : evaluations) {
    const evaluation::ProfileMeter& profile = evaluation.profile();
    for (const MarkingType type : kMarkingTypes)
      json[who]["lateral_error"][name(evaluation::line_kind(type))] = bands_json(profile.errors(type));
    json[who]["range"] = nlohmann::json::array();
    for (const auto& [bin, score] : profile.over_range()) json[who]["range"].push_back(bin_json(bin, score));
  }
  return json;
}

}  // namespace laneloom::commands
