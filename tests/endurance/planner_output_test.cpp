#include "endurance/planner_output.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <future>

#include "io/work_folder.hpp"

namespace laneloom::endurance {
namespace {

constexpr std::chrono::seconds kUntilFound(30), kInVain(1);

/// Whether `then`, written after `before`, is a map to wait for.
bool waits_for(const std::string& before, const std::string& then, std::chrono::seconds patience) {
  const io::WorkFolder folder;
  const std::string file = folder.file("planner");
  std::ofstream out(file);
  out << before << std::flush;
  auto found = std::async(std::launch::async, [&] { return wait_for_planner(file, 100, patience); });
  // Again and again: what comes before the wait began does not count.
  while (found.wait_for(std::chrono::milliseconds(200)) != std::future_status::ready)
    for (const char c : then) out << c << std::flush;  // seen in parts
  return found.get();
}

std::string map(int stamp_ns, const char* state) {
  return R"({"event":"map","stamp_ns":)" + std::to_string(stamp_ns) + R"(,"state":")" + state + "\"}\n";
}

TEST(PlannerOutput, AMapWithALaterFrame) {
  EXPECT_TRUE(waits_for("", map(101, "OK"), kUntilFound));
  EXPECT_TRUE(waits_for(R"({"event":"ma)", "\n" + map(101, "DEGRADED"), kUntilFound));
  EXPECT_FALSE(waits_for("", map(100, "OK"), kInVain)) << "of what was seen before";
}

TEST(PlannerOutput, NothingElse) {
  EXPECT_FALSE(waits_for("", map(101, "STALE"), kInVain));
  EXPECT_FALSE(waits_for(map(101, "OK"), "", kInVain));
  EXPECT_FALSE(waits_for("", "{\"event\":\"alive\"}\n[]\n1\nno JSON\n", kInVain));
}

}  // namespace
}  // namespace laneloom::endurance
