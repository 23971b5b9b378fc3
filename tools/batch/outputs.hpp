#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "batch/drives.hpp"
#include "batch/step.hpp"
#include "support/file_lock.hpp"

namespace laneloom::batch {

/// The folder below that of a batch which has its parts and logs, and what outputs were made of.
inline constexpr const char* kOwnFolder = ".batch";

/// Where the output of a step for a drive lies, below the folder of a batch.
std::filesystem::path output_path(const std::filesystem::path& folder, const Step& step, const Drive& drive);

/// A digest of a file's contents. Throws std::runtime_error if it cannot be read.
std::string digest_of(const std::filesystem::path& path);

/// Whether a batch with its outputs below this folder made the file, or is about to. Both paths are absolute.
bool is_output(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The output of a step for one drive, below the folder of a batch. As long as this, other batches wait that
/// would make the same output.
class Output {
 public:
  /// Looks at what the output is made of; the drive's contents are read where its size or its time of change
  /// is another one. `program` tells builds of laneloom apart. Throws std::runtime_error if something of it
  /// cannot be read.
  Output(const std::filesystem::path& folder, const Step& step, const Drive& drive,
         const std::string& program);

  /// Where the command writes, until it is done.
  const std::filesystem::path& part() const { return part_; }
  /// What the command prints.
  const std::filesystem::path& log() const { return log_; }

  /// Whether the output is there, made by the same program with the same options of the same contents
  /// of drive and files, and as long as it was then.
  bool is_made() const;
  /// Whether the command found something wrong when it made the output that is there.
  bool found_something() const;
  /// Makes the folders, and takes away a part that an interrupted batch left. Throws std::runtime_error if a
  /// file is in the place of the output that no batch made.
  void begin() const;
  /// Puts the part into its place, also over an earlier output, and notes what it was made of. Throws
  /// std::runtime_error if that has changed since: nobody knows what the command read.
  void finish(bool found_something) const;

 private:
  Step step_;
  Drive drive_;
  std::filesystem::path path_, part_, log_, record_;
  support::FileLock lock_;
  nlohmann::json noted_;    ///< the record of the output that is there
  nlohmann::json seen_;     ///< how the drive looks
  nlohmann::json made_of_;  ///< what the output is made of now
};

}  // namespace laneloom::batch
