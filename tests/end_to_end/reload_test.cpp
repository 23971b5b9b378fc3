#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "participants.hpp"
#include "process.hpp"
#include "service.hpp"

// SIGHUP: what of the configuration changes while laneloomd runs.
namespace laneloom {
namespace {

constexpr const char* kBefore = "service:\n  log_level: info\nmapper:\n  lane:\n    min_width_m: 2.3\n";

bool is_published(const PublishedMap&) { return true; }

TEST(Reload, TakesOverTheLogLevelAndNamesWhatNeedsARestart) {
  const TemporaryFile file("reload.yaml", kBefore);
  const auto config = private_config();
  const Process service(command(config, {"--config", file.path}));
  Listener<PublishedMap> maps(config);
  ASSERT_TRUE(maps.wait_for(is_published)) << service.errors();
  const auto session = maps.samples().back().session_id;
  EXPECT_EQ(service.errors().find("event=tick"), std::string::npos) << "a tick is logged at level debug";

  file.write("service:\n  log_level: debug\nmapper:\n  lane:\n    min_width_m: 2.25\n");
  service.signal(SIGHUP);
  ASSERT_TRUE(service.wait_for_error("event=reopened")) << service.errors();
  EXPECT_TRUE(service.wait_for_error("event=tick"));
  const auto log = service.errors();
  EXPECT_NE(log.find("event=changed key=service.log_level value=debug\n"), std::string::npos) << log;
  EXPECT_NE(log.find("event=needs_restart key=mapper.lane.min_width_m\n"), std::string::npos) << log;
  EXPECT_EQ(log.find("needs_restart key=service"), std::string::npos) << log;
  maps.forget();
  ASSERT_TRUE(maps.wait_for(is_published));
  EXPECT_EQ(maps.samples().back().session_id, session);
}

TEST(Reload, AnInvalidFileIsRefusedAndTheServiceGoesOn) {
  const TemporaryFile file("refused.yaml", kBefore);
  const auto config = private_config();
  const Process service(command(config, {"--config", file.path}));
  Listener<PublishedMap> maps(config);
  ASSERT_TRUE(maps.wait_for(is_published)) << service.errors();

  file.write("service:\n  log_level: debug\n  tick_rate_hz: 1000\n");
  service.signal(SIGHUP);
  ASSERT_TRUE(service.wait_for_error("event=reopened")) << service.errors();
  maps.forget();
  ASSERT_TRUE(maps.wait_for(is_published));
  const auto log = service.errors();
  EXPECT_NE(log.find("error event=configuration_refused reason=\"" + file.path +
                     ":3: service.tick_rate_hz: 1000 is not in 8 .. 100\""),
            std::string::npos)
      << log;
  EXPECT_EQ(log.find("event=changed"), std::string::npos) << log;
  EXPECT_EQ(log.find("event=tick"), std::string::npos) << log;

  // A mended file is taken.
  file.write("service:\n  log_level: debug\n");
  service.signal(SIGHUP);
  EXPECT_TRUE(service.wait_for_error("event=tick")) << service.errors();
}

TEST(Reload, SaysThatAProfileThatChangedNeedsARestart) {
  const std::string profile =
      "<dds xmlns='http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles'><profiles>"
      "<participant profile_name='mine'><rtps/></participant></profiles></dds>\n";
  const TemporaryFile profiles("profiles.xml", profile);
  const TemporaryFile file("profile.yaml",
                           "dds:\n  profile_file: " + profiles.path + "\n  profile_name: mine\n");
  const Process service(command(private_config(), {"--config", file.path}));
  ASSERT_TRUE(service.wait_for_error("event=started")) << service.errors();
  service.signal(SIGHUP);
  ASSERT_TRUE(service.wait_for_error("event=reopened")) << service.errors();
  EXPECT_EQ(service.errors().find("event=needs_restart"), std::string::npos) << service.errors();

  profiles.write(profile + "<!-- edited -->\n");
  service.signal(SIGHUP);
  EXPECT_TRUE(
      service.wait_for_error("event=needs_restart key=dds.profile_file why=\"its content changed\"\n"))
      << service.errors();
}

TEST(Reload, SaysThatFilesOfTheMapperThatChangedNeedARestart) {
  const std::string profile = "front: {stddev_at_8_m: {value: 0.03, weight: 5400}}\n";
  const TemporaryFile profiles("networks.yaml", profile);
  const std::string map =
      "<osm><node id='1' lat='0' lon='0'/><node id='2' lat='0.001' lon='0'/>"
      "<way id='3'><nd ref='1'/><nd ref='2'/><tag k='highway' v='primary'/></way></osm>\n";
  const TemporaryFile streets("streets.osm", map);
  const TemporaryFile file("files.yaml", "mapper:\n  fusion:\n    profile_file: " + profiles.path +
                                             "\nsd_map:\n  file: " + streets.path + "\n");
  const Process service(command(private_config(), {"--config", file.path}));
  ASSERT_TRUE(service.wait_for_error("event=started")) << service.errors();
  service.signal(SIGHUP);
  ASSERT_TRUE(service.wait_for_error("event=reopened")) << service.errors();
  EXPECT_EQ(service.errors().find("event=needs_restart"), std::string::npos) << service.errors();

  profiles.write(profile + "# edited\n");
  streets.write(map + "<!-- edited -->\n");
  service.signal(SIGHUP);
  for (const std::string key : {"mapper.fusion.profile_file", "sd_map.file"})
    EXPECT_TRUE(service.wait_for_error("event=needs_restart key=" + key + " why=\"its content changed\"\n"))
        << service.errors();

  // The next start would stay down.
  profiles.write("front: {stddev_at_8_m: {value: much, weight: 5400}}\n");
  service.signal(SIGHUP);
  EXPECT_TRUE(service.wait_for_error("error event=configuration_refused reason=\"" + profiles.path + ":1: "))
      << service.errors();
}

TEST(Reload, SaysThatTheNextStartWouldStayDown) {
  const TemporaryFile file("paths.yaml", kBefore);
  const Process service(command(private_config(), {"--config", file.path}));
  ASSERT_TRUE(service.wait_for_error("event=started")) << service.errors();
  const std::string missing = "/nonexistent";
  for (const auto& [section, complaint] :
       {std::pair<std::string, std::string>("dds:\n  profile_name: mine\n  profile_file: ",
                                            "dds.profile_file: there is no file " + missing),
        {"dds:\n  security_directory: ", "dds.security_directory: "},
        {"sd_map:\n  file: ", missing + ": is not a readable file"}}) {
    file.write(section + missing + "\n");
    service.signal(SIGHUP);
    EXPECT_TRUE(service.wait_for_error("error event=configuration_refused reason=\"" + complaint))
        << service.errors();
  }
}

TEST(Reload, AProfileThatIsGoneIsRefusedAndTheEndpointsStay) {
  const TemporaryFile profiles("gone.xml",
                               "<dds xmlns='http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles'><profiles>"
                               "<participant profile_name='mine'><rtps/></participant></profiles></dds>\n");
  const TemporaryFile file("gone.yaml",
                           "dds:\n  profile_file: " + profiles.path + "\n  profile_name: mine\n");
  const auto config = private_config();
  const Process service(command(config, {"--config", file.path}));
  Listener<PublishedMap> maps(config);
  ASSERT_TRUE(maps.wait_for(is_published)) << service.errors();
  unlink(profiles.path.c_str());
  service.signal(SIGHUP);
  ASSERT_TRUE(service.wait_for_error(
      "error event=reopening_refused reason=\"dds.profile_file: there is no file " + profiles.path + "\"\n"))
      << service.errors();
  const auto newest = maps.samples().back().sequence;
  EXPECT_TRUE(maps.wait_for([&](const PublishedMap& map) { return map.sequence > newest + 3; }));
  for (std::uint64_t i = 0; i < maps.samples().size(); ++i)
    EXPECT_EQ(maps.samples()[i].sequence, maps.samples()[0].sequence + i) << "the endpoints were made anew";
}

/// Receives the notices to systemd of processes that are started while this object lives.
class Notices {
 public:
  Notices() : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const std::string name = folder_.file("notify");
    sockaddr_un here{.sun_family = AF_UNIX, .sun_path = {}};
    name.copy(here.sun_path, sizeof here.sun_path - 1);
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0)
      throw std::runtime_error("no socket for notices");
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  ~Notices() {
    unsetenv("NOTIFY_SOCKET");
    close(socket_);
  }
  Notices(const Notices&) = delete;
  Notices& operator=(const Notices&) = delete;

  /// The next one; empty if none comes within a minute.
  std::string next() const {
    pollfd event{socket_, POLLIN, 0};
    std::string text(4096, '\0');
    const ssize_t size = poll(&event, 1, 60'000) > 0 ? recv(socket_, text.data(), text.size(), 0) : 0;
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }
  /// The notices before the next one that begins so.
  std::vector<std::string> until(const std::string& beginning) const {
    std::vector<std::string> before;
    std::string notice = next();
    for (; !notice.empty() && !notice.starts_with(beginning); notice = next()) before.push_back(notice);
    EXPECT_FALSE(notice.empty()) << "no " << beginning;
    return before;
  }

 private:
  TemporaryFolder folder_;
  int socket_;
};

// On a busy host, all steps together take longer than the watchdog waits.
TEST(Reload, TellsTheWatchdogBetweenItsSteps) {
  const Notices notices;
  const Process service(command(private_config()));
  notices.until("READY=1");
  service.signal(SIGHUP);
  notices.until("RELOADING=1");
  EXPECT_EQ(notices.until("READY=1"), (std::vector<std::string>{"WATCHDOG=1", "WATCHDOG=1"}));
}

TEST(Log, GoesToStandardErrorWhereThatIsNotTheJournal) {
  setenv("JOURNAL_STREAM", "8:1", 1);  // inherited from a service, but redirected
  const Process service(command(private_config()));
  unsetenv("JOURNAL_STREAM");
  EXPECT_TRUE(service.wait_for_error("info event=started")) << service.errors();
}

TEST(Log, ErrorsBeforeItHaveAPriorityInTheJournal) {
  const TemporaryFile file("wrong.yaml", "sync:\n  max_wiat_s: 0.5\n");
  for (const auto& options :
       {std::vector<std::string>{"--config", file.path}, std::vector<std::string>{"--nonsense"}}) {
    std::vector<std::string> words{
        "/bin/sh", "-c", "export JOURNAL_STREAM=$(stat -L -c %d:%i /dev/stderr); exec \"$0\" \"$@\""};
    for (const auto& word : command(private_config(), options)) words.push_back(word);
    Process service(words);
    EXPECT_NE(service.wait(), 0);
    std::istringstream lines(service.errors());
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      EXPECT_TRUE(line.starts_with("<3>laneloomd: ")) << line;
    }
    EXPECT_GT(count, 0);
  }
}

}  // namespace
}  // namespace laneloom
