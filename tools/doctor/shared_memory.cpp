#include <fmt/format.h>

#include <map>

#include "doctor/findings.hpp"

namespace laneloom::doctor {
namespace {

/// A text with the number of files of each owner.
std::string by_owner(const std::map<std::string, int>& files) {
  std::string text;
  for (const auto& [owner, count] : files)
    text += fmt::format("{}{} of {}", text.empty() ? "" : ", ", count, owner);
  return text;
}

}  // namespace

Findings shared_memory_findings(const Observed& seen) {
  if (seen.dds.transport != "udp+shm") return {};
  std::map<std::string, int> stale, of_others;
  for (const SharedMemoryFile& file : seen.shared_memory) {
    if (file.stale)
      ++stale[file.owner];
    else if (!file.ours)
      ++of_others[file.owner];
  }
  Findings found;
  if (!of_others.empty())
    found.push_back({"shared_memory_of_others",
                     fmt::format("Other users have shared memory of Fast DDS open: {}.", by_owner(of_others)),
                     "Participants of two users who both use shared memory choose it, can't open each "
                     "other's, and get nothing, without an error.",
                     "Run all participants as one user, or set dds.transport to udp on one side."});
  if (!stale.empty())
    found.push_back(
        {"stale_shared_memory",
         fmt::format("Files of Fast DDS in /dev/shm that no process has open: {}.", by_owner(stale)),
         "Processes that were killed left them. They take memory, and are in the way of others "
         "if they belong to another user.",
         "Remove them with `fastdds shm clean` (package fastdds-tools), which leaves those in use."});
  return found;
}

}  // namespace laneloom::doctor
