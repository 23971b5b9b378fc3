#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch/drives.hpp"
#include "batch/step.hpp"

namespace laneloom::batch {

/// A batch as a job array of Slurm. The nodes see the drives and the folder under the same paths.
struct JobArray {
  std::string laneloom;          ///< path of the program, on the nodes
  std::filesystem::path folder;  ///< of the outputs; absolute
  Step step;
  std::size_t tasks = 1;            ///< of the array; each takes its share of the drives
  std::vector<std::string> sbatch;  ///< more options of sbatch, for both jobs
};

/// Writes the list of drives and the two scripts into the folder: that of the array, and that of the job
/// behind it, which makes what is left and sums up. Returns the paths of the scripts. Throws
/// std::runtime_error naming the file that can't be written.
std::vector<std::filesystem::path> write_scripts(const JobArray& array, const std::vector<Drive>& drives);

/// Submits the scripts by sbatch, the second one behind the first. Returns the numbers of the jobs. Throws
/// std::runtime_error telling what sbatch said.
std::vector<std::string> submit(const JobArray& array, const std::vector<std::filesystem::path>& scripts);

}  // namespace laneloom::batch
