#include "endurance/planner_output.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <future>

#include "io/work_folder.hpp"

namespace laneloom {
namespace {

constexpr std::chrono::seconds kUntilFound(30), kInVain(1);

/// What was there before, what comes then, and whether that is a map to wait for.
bool waits_for(const std::string& before, const std::string& then, std::chrono::seconds patience) {
  const WorkFolder folder;
  const std::string file = folder.file("planner");
  std::ofstream out(file);
  out << before << std::flush;
  auto found = std::async(std::launch::async, [&] { return wait_for_planner(file, {7, 100}, patience); });
  // Again and again: what comes before the wait began does not count.
  while (found.wait_for(std::chrono::milliseconds(200)) != std::future_status::ready)
    for (const char c : then) out << c << std::flush;  // seen in parts
  return found.get();
}

std::string map(int session, int sequence, const char* state) {
  return R"({"event":"map","session_id":)" + std::to_string(session) + R"(,"sequence":)" +
         std::to_string(sequence) + R"(,"state":")" + state + "\"}\n";
}

TEST(PlannerOutput, ALaterMap) {
  EXPECT_TRUE(waits_for("", map(7, 101, "OK"), kUntilFound));
  EXPECT_TRUE(waits_for(R"({"event":"ma)", "\n" + map(7, 101, "DEGRADED"), kUntilFound));
  EXPECT_FALSE(waits_for("", map(7, 100, "OK"), kInVain)) << "on its way before";
  EXPECT_TRUE(waits_for("", map(8, 1, "OK"), kUntilFound)) << "of the next service";
}

TEST(PlannerOutput, NothingElse) {
  EXPECT_FALSE(waits_for("", map(7, 101, "STALE"), kInVain));
  EXPECT_FALSE(waits_for(map(7, 101, "OK"), "", kInVain));
  EXPECT_FALSE(waits_for("", "{\"event\":\"alive\"}\n[]\n1\nno JSON\n", kInVain));
}

}  // namespace
}  // namespace laneloom
