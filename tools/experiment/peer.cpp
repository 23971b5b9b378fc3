#include "experiment/peer.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/json_lines.hpp"
#include "io/work_folder.hpp"
#include "support/child_process.hpp"

namespace laneloom::experiment {
namespace {

/// Runs a command. Its output goes to standard error, because our standard output may be for a machine.
void run(const std::vector<std::string>& command) {
  support::ChildProcess process(command);
  if (process.wait() != 0) throw std::runtime_error(command[0] + ": " + process.failure());
}

/// Lets the peer fuse the frames into the files out.jsonl and report.json of the folder.
void run_in(const io::WorkFolder& folder, const Peer& peer, const std::vector<SimulatedFrame>& frames) {
  const std::string in = folder.file("in.jsonl");
  io::JsonLinesWriter writer(in);
  for (const SimulatedFrame& frame : frames) writer.write(frame.record);
  writer.close();
  run({peer.program, "--in", in, "--out", folder.file("out.jsonl"), "--report", folder.file("report.json"),
       "--preset", peer.preset});
}

TimeSummary time_summary(const nlohmann::json& times) {
  return {times.at("mean").get<double>(), times.at("p50").get<double>(), times.at("p99").get<double>(),
          times.at("max").get<double>()};
}

}  // namespace

std::vector<LocalMap> run_peer(const Peer& peer, const std::vector<SimulatedFrame>& frames) {
  const io::WorkFolder folder;
  run_in(folder, peer, frames);
  io::JsonLinesReader reader(folder.file("out.jsonl"));
  std::vector<LocalMap> maps;
  while (std::optional<LocalMap> map = reader.next_map()) maps.push_back(std::move(*map));
  if (maps.size() != frames.size())
    throw std::runtime_error(peer.program + ": has not given a map per frame");
  for (std::size_t i = 0; i < maps.size(); ++i) maps[i].stamp_ns = frames[i].record.frame.stamp_ns;
  return maps;
}

PeerReport time_peer(const Peer& peer, const std::vector<SimulatedFrame>& frames) {
  const io::WorkFolder folder;
  run_in(folder, peer, frames);
  try {
    std::ifstream in(folder.file("report.json"));
    const auto json = nlohmann::json::parse(in);
    PeerReport report;
    if (json.at("frames").get<std::size_t>() != frames.size())
      throw std::runtime_error("has not fused every frame");
    for (const auto& [stage, times] : json.at("ms").items()) report.stages[stage] = time_summary(times);
    report.total = report.stages.at("total");
    report.stages.erase("total");
    report.peak_rss_mb = json.at("peak_rss_mb").get<double>();
    return report;
  } catch (const std::exception& error) {
    throw std::runtime_error(peer.program + ": report: " + error.what());
  }
}

}  // namespace laneloom::experiment
