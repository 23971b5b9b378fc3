#include "endurance/planner_output.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "laneloom/state_names.hpp"

namespace laneloom::endurance {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// Whether a line of the planner shows a map as wait_for_planner() wants it. A line that is cut off does not.
bool is_fresh_map(const std::string& line, std::int64_t since_ns) {
  const auto update = nlohmann::json::parse(line, nullptr, false);
  if (!update.is_object() || update.value("event", "") != "map") return false;
  return update.at("stamp_ns") > since_ns && update.at("state") != name(MapState::stale);
}

}  // namespace

bool wait_for_planner(const std::string& file, std::int64_t since_ns, std::chrono::milliseconds patience) {
  const auto deadline = SteadyClock::now() + patience;
  std::ifstream in(file);
  in.seekg(0, std::ios::end);
  std::string line, part;
  while (SteadyClock::now() < deadline) {
    std::getline(in, part);
    line += part;
    if (!in.good()) {
      in.clear();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    } else {
      if (is_fresh_map(line, since_ns)) return true;
      line.clear();
    }
  }
  return false;
}

}  // namespace laneloom::endurance
