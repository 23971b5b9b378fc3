#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "batch/outputs.hpp"
#include "batch/run.hpp"
#include "batch/slurm.hpp"
#include "batch/summary.hpp"
#include "commands/commands.hpp"
#include "commands/exit_codes.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "config/network_profile.hpp"
#include "io/json_text.hpp"
#include "io/text_file.hpp"
#include "support/progress_bar.hpp"

namespace laneloom::commands {
namespace {

struct BatchOptions {
  std::vector<std::string> drives;
  std::string list, out, json, task;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  bool slurm = false, dry_run = false;
  std::size_t tasks = 0;
  std::vector<std::string> sbatch;
};

constexpr std::size_t kMostTasks = 1000;  // of a job array, as Slurm allows by default

std::string this_program() { return std::filesystem::canonical("/proc/self/exe").string(); }

/// The drives of one task of several, by words "I/N", of which each takes every N-th drive.
std::vector<batch::Drive> share_of(const std::string& task, std::vector<batch::Drive> drives) {
  std::size_t number = 0, count = 0;
  const char* const end = task.data() + task.size();
  const auto [slash, error] = std::from_chars(task.data(), end, number);
  const bool parsed = error == std::errc() && slash != end && *slash == '/' &&
                      std::from_chars(slash + 1, end, count).ptr == end;
  if (!parsed || number < 1 || number > count)
    throw CLI::ValidationError("--task", "must be I/N, with I from 1 to N");
  std::vector<batch::Drive> share;
  for (std::size_t i = number - 1; i < drives.size(); i += count) share.push_back(std::move(drives[i]));
  return share;
}

/// Where the profile of all drives is written; empty: the step has none.
std::string merged_profile(const BatchOptions& options, const batch::Step& step) {
  const bool merges = step.name == "learn" && options.task.empty();
  return merges ? (std::filesystem::path(options.out) / "merged.yaml").string() : std::string();
}

/// Refuses to write a summary over a file that the batch reads, or over an output.
void check_files(const BatchOptions& options, const batch::Step& step,
                 const std::vector<batch::Drive>& drives, std::vector<std::string> summaries) {
  summaries.insert(summaries.end(), {options.json, merged_profile(options, step)});
  std::vector<std::string> read{options.list};
  for (const batch::Drive& drive : drives) read.push_back(drive.path.string());
  for (const auto& file : batch::other_inputs(step, drives.front())) read.push_back(file.string());
  refuse_overwriting(read, summaries);
  const auto folder = std::filesystem::path(options.json).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw std::runtime_error(options.json + ": its folder is not there");
  for (const batch::Drive& drive : drives) {
    std::vector<std::string> written = summaries;
    written.push_back(batch::output_path(options.out, step, drive).string());
    refuse_overwriting({}, written);
  }
}

/// Merges what was learned of all drives.
void merge_profiles(const std::vector<batch::Result>& results, const std::string& out) {
  std::vector<NetworkProfiles> learned;
  for (const batch::Result& result : results)
    if (result.state != batch::Result::State::failed)
      learned.push_back(config::load_network_profiles(result.output));
  if (learned.empty()) return;
  io::write_text(out, fmt::format("# What laneloom learned from {} drives: mapper.fusion.profile_file starts "
                                  "with it.\n",
                                  learned.size()) +
                          config::dump(config::merged(learned)));
  fmt::print("{}: what was learned of {} drives\n", out, learned.size());
}

void submit_array(const BatchOptions& options, const batch::Step& step,
                  const std::vector<batch::Drive>& drives) {
  const std::size_t tasks = options.tasks > 0 ? options.tasks : std::min(drives.size(), kMostTasks);
  const batch::JobArray array{.laneloom = this_program(),
                              .folder = std::filesystem::absolute(options.out).lexically_normal(),
                              .step = step,
                              .tasks = std::min(tasks, drives.size()),
                              .sbatch = options.sbatch};
  check_files(options, step, drives, {(array.folder / "batch.json").string()});
  const auto scripts = batch::write_scripts(array, drives);
  if (options.dry_run) {
    for (const auto& script : scripts) fmt::print("{}\n", script.string());
    return;
  }
  const auto jobs = batch::submit(array, scripts);
  fmt::print("job {}: {} tasks for {} drives; job {} sums up, into {}\n", jobs.at(0), array.tasks,
             drives.size(), jobs.at(1), (array.folder / "batch.json").string());
}

void run_batch(const BatchOptions& options, std::vector<std::string> words) {
  if (words.empty()) throw CLI::RequiredError("the step: replay, evaluate, learn, export or check");
  const batch::Step step{.name = words.front(), .options = {words.begin() + 1, words.end()}};
  static_cast<void>(batch::kind_of(step));  // throws
  std::vector<batch::Drive> drives = batch::find_drives(options.drives, options.list, options.out);
  std::filesystem::create_directories(options.out);
  if (options.slurm) return submit_array(options, step, drives);
  if (!options.task.empty()) drives = share_of(options.task, std::move(drives));
  check_files(options, step, drives, {});
  support::ProgressBar bar;
  const auto results =
      batch::run({.laneloom = this_program(), .step = step, .folder = options.out, .jobs = options.jobs},
                 drives, [&](double share) { bar.step(share); });
  bar.clear();
  fmt::print("{}", batch::table(step, results));
  if (const std::string merged = merged_profile(options, step); !merged.empty())
    merge_profiles(results, merged);
  if (!options.json.empty())
    io::write_text(options.json, io::json_text(batch::to_json(step, results), 2) + "\n");
  if (std::ranges::any_of(results, [](const auto& one) { return one.state == batch::Result::State::failed; }))
    end_with(kFoundWrong);
}

}  // namespace

void add_batch(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "batch",
      "Runs a step on many drives: laneloom batch --drives 'night/*.mcap' --out rated evaluate --later. The "
      "step, which comes last with its own options, is replay, evaluate, learn, export or check");
  const auto options = std::make_shared<BatchOptions>();
  command->prefix_command();
  command
      ->add_option("--drives", options->drives,
                   "A drive, a folder of drives, or a pattern with * and ?; may be given several times")
      ->expected(1)
      ->allow_extra_args(false)  // the step may follow
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--list", options->list, "File with one of these a line")->check(CLI::ExistingFile);
  command->add_option("--out", options->out, "Folder of the outputs, one for each drive")->required();
  command->add_option("--jobs", options->jobs, "Drives at a time; default: one for each CPU")
      ->check(CLI::Range(1U, 1024U));
  add_text_output(*command, "--json", options->json, "Summary to write (.json)");
  CLI::Option* task =
      command->add_option("--task", options->task, "I/N: take every N-th drive alone, from the I-th on");
  CLI::Option* slurm = command
                           ->add_flag("--slurm", options->slurm,
                                      "Submit the batch as a job array of Slurm, and a job that sums up")
                           ->excludes(task);
  command->add_option("--tasks", options->tasks, "Tasks of the job array; default: one for each drive")
      ->needs(slurm)
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000000}));
  command->add_option("--sbatch", options->sbatch, "Option for sbatch, as --sbatch=--partition=night")
      ->needs(slurm)
      ->expected(1)
      ->allow_extra_args(false)  // the step may follow
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--dry-run", options->dry_run, "Write the scripts for Slurm, and submit nothing")
      ->needs(slurm);
  command->footer(
      "An output that is there, made by the same version with the same options of the same files, is kept: a "
      "batch that was interrupted goes on where it stopped. Exit code: 2 where drives failed.");
  command->callback([command, options] { run_batch(*options, command->remaining()); });
}

}  // namespace laneloom::commands
