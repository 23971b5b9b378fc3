#include <csignal>
#include <set>
#include <sstream>

#include "processes.hpp"

namespace laneloom::doctor {
namespace {

using testing::HasSubstr;

class Status : public Processes {
 protected:
  const std::string once_ = "status --once --json" + here_;
};

TEST_F(Status, NobodyIsHeard) {
  EXPECT_EQ(run("status --once --duration 0.5" + here_), 3);
  EXPECT_THAT(output(), HasSubstr("no service of vehicle \"" + vehicle_ + "\" was heard"));
}

TEST_F(Status, AVehicleIdThatMeansManyVehiclesIsRefused) {
  EXPECT_NE(run("publish --scenario straight" + of(domain_, "'car_?'")), 0);
  EXPECT_THAT(output(), HasSubstr("--vehicle-id: \"car_?\" is not 1 to 64 letters"));
}

TEST_F(Status, TheExitCodeIsTheState) {
  const support::ChildProcess running = start(service_, "service.log");
  ASSERT_TRUE(run_until(once_, [](int code) { return code == 4; })) << output();
  EXPECT_EQ(json().at("state"), "STALE");
  EXPECT_THAT(json().at("reasons"), testing::Contains("no_detections"));
  EXPECT_TRUE(json().at("detections_age_s").is_null());

  const support::ChildProcess publishing = start(publisher_ + here_, "publish.log");
  ASSERT_TRUE(run_until(once_, [](int code) { return code == 0; })) << output();
  EXPECT_EQ(json().at("state"), "OK");
  EXPECT_GT(json().at("counters").at("frames_fused"), 0);
  EXPECT_EQ(json().at("sources").at(0).at("source"), "laneloom publish");

  const support::ChildProcess other = start(service_, "other.log");
  EXPECT_TRUE(run_until(once_, [&](int code) {
    return code == 2 && json().at("reasons") == nlohmann::json{"another_service"};
  })) << output();
}

TEST_F(Status, FollowsAllServicesOfAVehicle) {
  const support::ChildProcess one = start(service_, "one.log");
  const support::ChildProcess other = start(service_, "other.log");
  support::ChildProcess status = start("laneloom status --json" + here_, "status.log");
  std::set<std::uint64_t> sessions;
  bool rose = false;
  for (int i = 0; i < 600 && !(rose && sessions.size() == 2); ++i) {
    usleep(50'000);
    std::istringstream lines(text("status.log"));
    for (std::string line; std::getline(lines, line) && !lines.eof();) {
      const auto json = nlohmann::json::parse(line);
      sessions.insert(json.at("session_id").get<std::uint64_t>());
      rose = rose || (json.at("rises").is_object() && json.at("rises").value("ticks", 0) > 0);
    }
  }
  EXPECT_EQ(sessions.size(), 2U);
  EXPECT_TRUE(rose);
  status.signal(SIGTERM);
  EXPECT_EQ(status.wait(), 4) << "the newest status said STALE";
}

TEST_F(Status, IsRedrawnInPlaceOnATerminal) {
  const support::ChildProcess one = start(service_, "one.log");
  const support::ChildProcess other = start(service_, "other.log");
  const support::ChildProcess terminal =
      start("script -q -f -c 'laneloom status" + here_ + "' /dev/null", "terminal.log");
  const auto shown = [&] { return text("terminal.log"); };
  for (int i = 0; i < 600 && shown().find("2 SERVICES OF ONE VEHICLE") == std::string::npos; ++i)
    usleep(50'000);
  EXPECT_THAT(shown(), HasSubstr("2 SERVICES OF ONE VEHICLE"));
  EXPECT_THAT(shown(), HasSubstr("A\x1b[J")) << "nothing was drawn over";
}

}  // namespace
}  // namespace laneloom::doctor
