#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "batch/drives.hpp"
#include "batch/step.hpp"

namespace laneloom::batch {

/// The folder below that of a batch which has its parts and logs, and what outputs were made of.
inline constexpr const char* kOwnFolder = ".batch";

/// Where the output of a step for a drive lies, below the folder of a batch.
std::filesystem::path output_path(const std::filesystem::path& folder, const Step& step, const Drive& drive);

/// A digest of a file's contents. Throws std::runtime_error if it cannot be read.
std::string digest_of(const std::filesystem::path& path);

/// Whether a batch with its outputs below this folder made the file, or is about to. Both paths are absolute.
bool is_output(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The output of a step for one drive, below the folder of a batch.
class Output {
 public:
  /// `program` tells builds of laneloom apart.
  Output(const std::filesystem::path& folder, const Step& step, const Drive& drive, std::string program);

  const std::filesystem::path& path() const { return path_; }
  /// Where the command writes, until it is done.
  const std::filesystem::path& part() const { return part_; }
  /// What the command prints.
  const std::filesystem::path& log() const { return log_; }

  /// Whether the output is there, made by the same program with the same options of the same contents
  /// of drive and files. The drive's contents are read where its size or its time of change is another one.
  bool is_made() const;
  /// Makes the folders, and takes away a part that an interrupted batch left. Throws std::runtime_error if a
  /// file is in the place of the output that no batch made.
  void begin() const;
  /// Puts the part into its place, also over an earlier output, and notes what it was made of.
  void finish() const;

 private:
  nlohmann::json made_of(const nlohmann::json& before) const;

  Step step_;
  Drive drive_;
  std::string program_;
  std::filesystem::path path_, part_, log_, record_;
};

}  // namespace laneloom::batch
