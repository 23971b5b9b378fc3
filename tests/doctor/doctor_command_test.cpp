#include "processes.hpp"

namespace laneloom::doctor {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Value;

class Doctor : public Processes {
 protected:
  const std::string doctor_ = "doctor --json" + here_;

  std::vector<std::string> ids() const {
    const nlohmann::json report = json();
    std::vector<std::string> result;
    for (const auto& finding : report.at("findings")) result.push_back(finding.at("id"));
    return result;
  }
  std::string found(const std::string& id) const {
    const nlohmann::json report = json();
    for (const auto& finding : report.at("findings"))
      if (finding.at("id") == id) return finding.at("found");
    return {};
  }
  /// Until the finding says `text`.
  bool run_until_found(const std::string& words, const std::string& id,
                       const testing::Matcher<std::string>& text = Not(testing::IsEmpty())) const {
    return run_until(words, [&](int code) { return code == 2 && Value(found(id), text); });
  }
};

TEST_F(Doctor, FindsNothingWhereNothingIsWrong) {
  const support::ChildProcess running = start(service_, "service.log");
  const support::ChildProcess publishing = start(publisher_ + here_, "publish.log");
  EXPECT_TRUE(run_until(doctor_, [](int code) { return code == 0; })) << output();
  EXPECT_TRUE(json().at("findings").empty());
  EXPECT_EQ(json().at("participants").size(), 2U);
  EXPECT_TRUE(run_until("doctor" + here_, [](int code) { return code == 0; }));
  EXPECT_THAT(output(), HasSubstr("Nothing wrong was found."));
}

TEST_F(Doctor, FindsAWrongPartition) {
  const support::ChildProcess running = start(service_, "service.log");
  const support::ChildProcess publishing = start(publisher_ + of(domain_, "other"), "publish.log");
  const auto partition = AllOf(HasSubstr("\"laneloom publish\""),
                               HasSubstr("in the partition \"other\", not \"" + vehicle_ + "\""));
  const auto others = testing::IsSupersetOf({"no_detections", "no_poses", "state_no_detections"});
  EXPECT_TRUE(run_until(doctor_, [&](int code) {
    return code == 2 && Value(found("wrong_partition"), partition) && Value(ids(), others);
  })) << output();
}

/// Those who find each other through a server of this host.
class DoctorBehindAServer : public Doctor {
 protected:
  void SetUp() override {
    if (access(kServer, X_OK) != 0) GTEST_SKIP() << "there is no discovery server (fastdds-tools)";
    std::string profile = content(LANELOOM_PROFILES "/" SERVER_PROFILE ".xml");
    const auto replace = [&](const std::string& from, const std::string& to) {
      for (auto at = profile.find(from); at != std::string::npos; at = profile.find(from, at + to.size()))
        profile.replace(at, from.size(), to);
    };
    replace("192.0.2.1", "127.0.0.1");
    replace("11811", port_);
    std::ofstream(file("profile.xml")) << profile;
    std::ofstream(file("config.yaml"))
        << "dds:\n  profile_file: " << file("profile.xml") << "\n  profile_name: " SERVER_PROFILE "\n";
  }

  static constexpr const char* kServer = "/usr/bin/fast-discovery-server";
  const std::string port_ = std::to_string(20000 + getpid() % 10000);
  const std::string server_ = kServer + (" -i 0 -l 127.0.0.1 -p " + port_);
  const std::string configured_ = " --config config.yaml";
};

TEST_F(DoctorBehindAServer, SeesEverybody) {
  const support::ChildProcess serving = start(server_, "server.log");
  const support::ChildProcess running = start(service_ + configured_, "service.log");
  const support::ChildProcess publishing =
      start(publisher_ + of(domain_, "other") + "--profile-file profile.xml --profile-name " SERVER_PROFILE,
            "publish.log");
  EXPECT_TRUE(run_until_found(doctor_ + configured_, "wrong_partition",
                              HasSubstr("in the partition \"other\", not \"" + vehicle_ + "\"")))
      << output();
}

TEST_F(DoctorBehindAServer, FindsThatTheServerDoesNotAnswer) {
  EXPECT_EQ(run(doctor_ + configured_), 2);
  EXPECT_THAT(ids(), ElementsAre("no_discovery_server"));
  EXPECT_THAT(found("no_discovery_server"), HasSubstr("127.0.0.1:" + port_));
  const support::ChildProcess serving = start(server_, "server.log");
  EXPECT_TRUE(run_until_found(doctor_ + configured_, "no_service")) << output();
}

TEST_F(Doctor, FindsAServiceOfAnotherVehicle) {
  const support::ChildProcess running = start(service_, "service.log");
  EXPECT_TRUE(run_until_found("doctor --json" + of(domain_, "other"), "no_service",
                              HasSubstr("services in the partition \"" + vehicle_ + "\"")))
      << output();
}

TEST_F(Doctor, FindsAWrongDomain) {
  const support::ChildProcess running = start(service_, "service.log");
  const DomainLease empty;
  const std::string words = "doctor --json --duration 1" + of(empty.number(), vehicle_);
  EXPECT_TRUE(run_until(words, [&](int code) {
    return code == 2 && found("empty_domain").find(" " + std::to_string(domain_)) != std::string::npos;
  })) << output();
  EXPECT_THAT(ids(), ElementsAre("empty_domain"));
}

TEST_F(Doctor, FindsTwoServicesAndWhatTheySay) {
  const support::ChildProcess one = start(service_, "one.log");
  const support::ChildProcess other = start(service_, "other.log");
  ASSERT_TRUE(run_until_found(doctor_, "two_services")) << output();
  EXPECT_TRUE(run_until_found(doctor_, "state_another_service")) << output();
}

TEST_F(Doctor, FindsAServiceThatIsStopped) {
  const support::ChildProcess running = start(service_, "service.log");
  ASSERT_TRUE(run_until_found(doctor_, "state_no_detections")) << output();
  running.signal(SIGSTOP);
  EXPECT_TRUE(run_until_found(doctor_, "service_stopped")) << output();
  EXPECT_THAT(found("service_stopped"), HasSubstr(std::to_string(running.id())));
}

TEST_F(Doctor, FindsPosesInAnotherFrame) {
  std::ofstream(file("config.yaml")) << "dds:\n  map_frame_id: utm\n";
  const support::ChildProcess running = start(service_ + "--config config.yaml", "service.log");
  const support::ChildProcess publishing = start(publisher_ + here_, "publish.log");
  ASSERT_TRUE(run_until_found(doctor_, "poses_refused_wrong_frame")) << output();
  EXPECT_THAT(found("poses_refused_wrong_frame"), HasSubstr("The service refused"));
}

TEST_F(Doctor, FindsAWrongConfiguration) {
  std::ofstream(file("config.yaml")) << "dds:\n  domain: 1\n  vehicle: ego\n";
  EXPECT_EQ(run("doctor --json --config config.yaml"), 2);
  EXPECT_THAT(ids(), ElementsAre("configuration"));
  EXPECT_THAT(found("configuration"), HasSubstr("config.yaml:3: dds.vehicle"));

  std::ofstream(file("config.yaml")) << "dds:\n  profile_file: /nowhere.xml\n  profile_name: mine\n";
  EXPECT_EQ(run("doctor --json --config config.yaml"), 2);
  EXPECT_THAT(ids(), ElementsAre("participant"));
  EXPECT_THAT(found("participant"), HasSubstr("/nowhere.xml"));
}

TEST_F(Doctor, OptionsOverrideTheConfigurationWhereverTheyStand) {
  std::ofstream(file("config.yaml")) << "dds:\n  domain: 99\n  vehicle_id: of_the_file\n";
  const std::string domain = std::to_string(domain_);
  for (const std::string& options :
       {"--domain " + domain + " --config config.yaml", "--config config.yaml --domain " + domain}) {
    run("doctor --json --duration 1 " + options);
    EXPECT_EQ(json().at("domain"), domain_);
    EXPECT_EQ(json().at("vehicle_id"), "of_the_file");
  }
}

}  // namespace
}  // namespace laneloom::doctor
