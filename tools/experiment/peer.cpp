#include "experiment/peer.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "io/json_lines.hpp"

extern char** environ;

namespace laneloom {
namespace {

/// A folder that is gone when this ends.
class WorkFolder {
 public:
  WorkFolder() : path_(std::filesystem::temp_directory_path() / "laneloom_peer_XXXXXX") {
    if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder for the peer");
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  std::string file(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

void run(std::vector<std::string> command) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t id = 0;
  if (posix_spawn(&id, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
    throw std::runtime_error(command[0] + ": cannot be run");
  int status = 0;
  if (waitpid(id, &status, 0) != id || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(command[0] + ": failed");
}

}  // namespace

std::vector<LocalMap> run_peer(const Peer& peer, const std::vector<SimulatedFrame>& frames) {
  const WorkFolder folder;
  const std::string in = folder.file("in.jsonl"), out = folder.file("out.jsonl");
  JsonLinesWriter writer(in);
  for (const SimulatedFrame& frame : frames) writer.write(frame.record);
  writer.close();
  run({peer.program, "--in", in, "--out", out, "--report", folder.file("report.json"), "--preset",
       peer.preset});
  JsonLinesReader reader(out);
  std::vector<LocalMap> maps;
  while (std::optional<LocalMap> map = reader.next_map()) maps.push_back(std::move(*map));
  if (maps.size() != frames.size())
    throw std::runtime_error(peer.program + ": has not given a map per frame");
  for (std::size_t i = 0; i < maps.size(); ++i) maps[i].stamp_ns = frames[i].record.frame.stamp_ns;
  return maps;
}

}  // namespace laneloom
