#include "batch/step.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "config/config_file.hpp"

namespace laneloom::batch {
namespace {

const std::array kKinds{
    StepKind{.name = "replay",
             .suffix = ".maps.mcap",
             .option = "--out",
             .other_outputs = {"--report"},
             .figures = {}},
    StepKind{.name = "evaluate",
             .suffix = ".json",
             .option = "--json",
             .other_outputs = {"--plots"},
             .figures = {"/fused/total/f1", "/fused/lane/f1", "/fused/topology/linkages/precision",
                         "/fused/topology/directions/precision", "/planner/own_lane",
                         "/fused/planner/own_lane", "/planner/blinks_per_s", "/fused/planner/blinks_per_s",
                         "/planner/kink_p99_deg", "/fused/planner/kink_p99_deg"}},
    StepKind{.name = "learn", .suffix = ".yaml", .option = "--out", .other_outputs = {}, .figures = {}},
    StepKind{.name = "export",
             .suffix = ".osm",
             .option = "--lanelet2",
             .other_outputs = {"--opendrive", "--geojson", "--report"},
             .figures = {}},
    StepKind{.name = "check",
             .suffix = ".check.json",
             .option = "--out",
             .other_outputs = {},
             .figures = {},
             .may_find_something = true}};

const std::string kConfiguration = "--config";

bool has(const Step& step, const std::string& option) {
  return std::ranges::any_of(step.options, [&](const std::string& word) {
    return word == option || word.starts_with(option + "=");
  });
}

/// Adds the files that a configuration names, and maps depend on.
void add_named_by(const std::string& configuration, std::vector<std::filesystem::path>& files) {
  const Config config = config::load_config(configuration);
  for (const std::string& file : {config.mapper.fusion.profile_file, config.sd_map.file})
    if (!file.empty()) files.emplace_back(file);
}

/// The truth that a step rates a drive by.
std::optional<std::filesystem::path> truth_of(const Step& step, const Drive& drive) {
  if (step.name != "evaluate" || has(step, "--later") || has(step, "--truth")) return std::nullopt;
  const std::string file_name = std::filesystem::path(drive.name).filename().string();
  return drive.path.parent_path() / (file_name + ".truth.json");
}

}  // namespace

const StepKind& kind_of(const Step& step) {
  const auto kind = std::ranges::find(kKinds, step.name, &StepKind::name);
  if (kind == kKinds.end()) {
    std::vector<std::string> names;
    for (const StepKind& one : kKinds) names.push_back(one.name);
    throw std::runtime_error(
        fmt::format("'{}' is no step of a batch; these are: {}", step.name, fmt::join(names, ", ")));
  }
  if (has(step, kind->option))
    throw std::runtime_error(
        fmt::format("{} {}: batch names the output of each drive", step.name, kind->option));
  for (const std::string& option : kind->other_outputs)
    if (has(step, option))
      throw std::runtime_error(fmt::format("{} {}: all drives would write to one place", step.name, option));
  return *kind;
}

std::vector<std::string> command_line(const std::string& laneloom, const Step& step, const Drive& drive,
                                      const std::filesystem::path& output) {
  std::vector<std::string> words{laneloom, step.name, "--in", drive.path.string()};
  words.insert(words.end(), step.options.begin(), step.options.end());
  if (const auto truth = truth_of(step, drive)) words.insert(words.end(), {"--truth", truth->string()});
  words.insert(words.end(), {kind_of(step).option, output.string()});
  return words;
}

std::vector<std::filesystem::path> other_inputs(const Step& step, const Drive& drive) {
  std::vector<std::filesystem::path> files;
  bool of_configuration = false;
  for (const std::string& word : step.options) {
    const bool is_option = word.starts_with("-");
    if (is_option) of_configuration = word == kConfiguration || word.starts_with(kConfiguration + "=");
    const std::string file = is_option ? word.substr(word.find('=') + 1) : word;
    if (!std::filesystem::is_regular_file(file)) continue;
    files.emplace_back(file);
    if (of_configuration) add_named_by(file, files);
  }
  if (const auto truth = truth_of(step, drive)) files.push_back(*truth);
  return files;
}

}  // namespace laneloom::batch
