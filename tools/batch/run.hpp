#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "batch/drives.hpp"
#include "batch/step.hpp"

namespace laneloom::batch {

/// What became of a drive.
struct Result {
  enum class State { made, kept, failed };

  Drive drive;
  State state = State::failed;
  double duration_s = 0.0;       ///< 0: it was kept
  bool found_something = false;  ///< the command ended with exit code 2, which is no failure
  std::string problem;           ///< empty: there was none
  std::filesystem::path output;
};

struct Work {
  std::string laneloom;  ///< path of the program
  Step step;
  std::filesystem::path folder;  ///< of the outputs
  unsigned jobs = 1;             ///< drives at a time
};

/// Runs a step on drives, each in a process of its own: one that crashes does not end the others. An output
/// that is there already, and was made of the same, is kept. `on_step` is called behind each drive, by one
/// thread at a time, with the share of drives that are done. Results are in the order of the drives. Throws
/// std::runtime_error if the step is none.
std::vector<Result> run(const Work& work, const std::vector<Drive>& drives,
                        const std::function<void(double)>& on_step);

}  // namespace laneloom::batch
