#include "batch/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "batch/outputs.hpp"
#include "io/text_file.hpp"
#include "support/child_process.hpp"

namespace laneloom::batch {
namespace {

namespace fs = std::filesystem;

/// A word as the shell takes it, whatever is in it.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// A path as a directive takes it for a pattern of file names.
std::string in_directive(const fs::path& path) {
  std::string text = "\"";
  for (const char c : path.string()) {
    if (c == '"' || c == '\\') text += '\\';
    if (c == '%') text += '%';
    text += c;
  }
  return text + "\"";
}

/// Writes the list of drives. Each list has a name of its own: jobs of another one may wait.
fs::path write_list(const std::vector<Drive>& drives, const fs::path& own) {
  std::string list;
  for (const Drive& drive : drives)
    list += drive.folder.string() + kNamesBegin + drive.path.lexically_relative(drive.folder).string() + "\n";
  if (std::ranges::count(list, '\n') != std::ssize(drives))
    throw std::runtime_error("the name of a drive has a line break, and cannot stand in a list");
  io::write_text(own / "drives.txt", list);
  fs::path named = own / ("drives." + digest_of(own / "drives.txt") + ".txt");
  fs::rename(own / "drives.txt", named);
  return named;
}

std::string batch_command(const JobArray& array, const fs::path& list, const std::string& more) {
  std::string text = fmt::format("exec {} batch --list {} --out {} {}", quoted(array.laneloom),
                                 quoted(list.string()), quoted(array.folder.string()), more);
  text += " " + quoted(array.step.name);
  for (const std::string& option : array.step.options) text += " " + quoted(option);
  return text + "\n";
}

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

std::vector<fs::path> write_scripts(const JobArray& array, const std::vector<Drive>& drives) {
  const fs::path own = array.folder / kOwnFolder;
  fs::create_directories(own);
  const fs::path list = write_list(drives, own);
  const auto script = [&](const std::string& name, const std::string& directives, const std::string& more) {
    io::write_text(own / name, fmt::format("#!/bin/sh\n#SBATCH --job-name=laneloom-{}\n#SBATCH --ntasks=1\n"
                                           "#SBATCH --requeue\n#SBATCH --open-mode=append\n{}{}",
                                           array.step.name, directives, batch_command(array, list, more)));
    return own / name;
  };
  return {script("array.sh",
                 fmt::format("#SBATCH --array=1-{}\n#SBATCH --output={}/task-%a.log\n", array.tasks,
                             in_directive(own)),
                 fmt::format("--jobs 1 --task \"$SLURM_ARRAY_TASK_ID/{}\"", array.tasks)),
          script("summary.sh", fmt::format("#SBATCH --output={}\n", in_directive(array.folder / "batch.log")),
                 fmt::format("--jobs 1 --json {}", quoted((array.folder / "batch.json").string())))};
}

std::vector<std::string> submit(const JobArray& array, const std::vector<fs::path>& scripts) {
  std::vector<std::string> jobs;
  for (const fs::path& script : scripts) {
    std::vector<std::string> words{"/usr/bin/env", "sbatch", "--parsable"};
    if (!jobs.empty()) words.push_back("--dependency=afterany:" + jobs.back());
    words.insert(words.end(), array.sbatch.begin(), array.sbatch.end());
    words.push_back(script.string());
    const fs::path output = script.string() + ".sbatch";
    support::ChildProcess sbatch(words, output.string());
    const int code = sbatch.wait();
    std::string said = content(output);
    if (!said.empty() && said.back() == '\n') said.pop_back();
    if (code != 0) throw std::runtime_error("sbatch: " + (said.empty() ? sbatch.failure() : said));
    jobs.push_back(said.substr(0, said.find(';')));  // "number;cluster"
  }
  return jobs;
}

}  // namespace laneloom::batch
