#include "batch/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <fstream>
#include <mutex>
#include <string_view>
#include <thread>

#include "batch/outputs.hpp"
#include "support/child_process.hpp"

namespace laneloom::batch {
namespace {

// Exit codes of a command (commands/exit_codes.hpp).
constexpr int kFoundSomething = 2;
constexpr int kWrongUse = 64;

/// The line in which a command told its error: of wrong use the first one, before the usage, and else its
/// last complaint, which standard output and lines below may follow.
std::string error_in(const std::filesystem::path& log, int code) {
  constexpr std::string_view kProgram = "laneloom: ";
  std::ifstream file(log);
  std::string complaint, last;
  for (std::string line; std::getline(file, line) && (last.empty() || code != kWrongUse);) {
    if (!line.empty()) last = line;
    if (line.starts_with(kProgram) && !line.ends_with(':')) complaint = line.substr(kProgram.size());
  }
  return complaint.empty() || code < 0 ? last : complaint;
}

void make(const Work& work, const Output& output, Result& result) {
  output.begin();
  const auto begin = std::chrono::steady_clock::now();
  support::ChildProcess command(command_line(work.laneloom, work.step, result.drive, output.part()),
                                output.log().string());
  const int code = command.wait();
  result.duration_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.found_something = code == kFoundSomething && kind_of(work.step).may_find_something;
  if (code != 0 && !result.found_something) {
    const std::string line = error_in(output.log(), code);
    result.problem = line.empty() ? command.failure() : fmt::format("{} ({})", line, command.failure());
    return;
  }
  output.finish(result.found_something);
  result.state = Result::State::made;
}

Result result_of(const Work& work, const Drive& drive, const std::string& program) {
  Result result{.drive = drive, .output = output_path(work.folder, work.step, drive)};
  try {
    const Output output(work.folder, work.step, drive, program);
    if (!output.is_made()) {
      make(work, output, result);
      return result;
    }
    result.state = Result::State::kept;
    result.found_something = output.found_something();
  } catch (const std::exception& error) {
    result.problem = error.what();
  }
  return result;
}

}  // namespace

std::vector<Result> run(const Work& work, const std::vector<Drive>& drives,
                        const std::function<void(double)>& on_step) {
  static_cast<void>(kind_of(work.step));  // throws
  const std::string program = digest_of(work.laneloom);
  std::vector<Result> results(drives.size());
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex mutex;
  const auto work_on = [&] {
    for (std::size_t i = next++; i < drives.size(); i = next++) {
      results[i] = result_of(work, drives[i], program);
      const std::scoped_lock lock(mutex);
      on_step(static_cast<double>(++done) / static_cast<double>(drives.size()));
    }
  };
  std::vector<std::jthread> workers;
  for (unsigned i = 1; i < work.jobs; ++i) workers.emplace_back(work_on);
  work_on();
  workers.clear();  // waits for them
  return results;
}

}  // namespace laneloom::batch
