#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch/drives.hpp"

namespace laneloom::batch {

/// A command of laneloom that is run on each drive.
struct Step {
  std::string name;                  ///< of the command
  std::vector<std::string> options;  ///< more words of the command line

  bool operator==(const Step&) const = default;
};

/// What a command makes of a drive.
struct StepKind {
  std::string name;
  std::string suffix;                      ///< of the output
  std::string option;                      ///< that names the output
  std::vector<std::string> other_outputs;  ///< options that name others, which a batch has not
  std::vector<std::string> figures;        ///< of the output (JSON), those that are shown, as JSON pointers
  bool may_find_something = false;         ///< exit code 2 tells of the drive, and is no failure
};

/// The kind of a step. Throws std::runtime_error naming the commands that can be a step, if it is none of
/// them, or naming an option that batch itself gives, or by which all drives would write to one place.
const StepKind& kind_of(const Step& step);

/// The command line that makes `output` of a drive. A step that rates drives by their truth takes it from
/// beside the drive: that of NAME.mcap or NAME.frames.jsonl is NAME.truth.json.
std::vector<std::string> command_line(const std::string& laneloom, const Step& step, const Drive& drive,
                                      const std::filesystem::path& output);

/// The files that a drive's output is made of, other than the drive: those that options name, those that a
/// configuration among them names, and the truth. Throws ConfigError if a configuration cannot be read.
std::vector<std::filesystem::path> other_inputs(const Step& step, const Drive& drive);

}  // namespace laneloom::batch
