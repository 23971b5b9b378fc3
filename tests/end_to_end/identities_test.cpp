#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "identities.hpp"
#include "participants.hpp"
#include "process.hpp"
#include "service.hpp"

// The folders that tools/make-certificates makes, and what becomes of a service whose folder is not in order.
namespace laneloom {
namespace {

namespace fs = std::filesystem;

constexpr int kUnreadable = 78;   ///< for good
constexpr int kNotBelieved = 77;  ///< as long as the clock may be what is wrong

/// A copy of the service's folder, damaged, must stop the start, and be named, with what is wrong in it.
void expect_refused(const Identities& identities, int code, const std::string& what,
                    const std::function<void(const fs::path&)>& damage, const std::string& reason = "") {
  const fs::path folder = identities.folder() / "damaged";
  fs::remove_all(folder);
  fs::copy(identities.folder() / "service", folder);
  damage(folder);
  Service service(identities.as("damaged", private_config()));
  EXPECT_EQ(service.wait(), code) << what;
  EXPECT_NE(service.errors().find("dds.security_directory: "), std::string::npos) << what << service.errors();
  EXPECT_NE(service.errors().find(folder), std::string::npos) << what << service.errors();
  EXPECT_NE(service.errors().find(reason), std::string::npos) << what << service.errors();
  EXPECT_EQ(service.errors().find("event=started"), std::string::npos) << what;
  Process check(command(private_config(), {"--config", service.path, "--check-config"}));
  EXPECT_EQ(check.wait(), code) << what;
}

TEST(Identities, AFolderThatIsNotInOrderStopsTheStart) {
  const Identities identities;
  const Identities others;
  for (const std::string name : {"identity_ca.cert.pem", "permissions_ca.cert.pem", "cert.pem", "key.pem",
                                 "governance.p7s", "permissions.p7s"}) {
    expect_refused(identities, kUnreadable, "no " + name,
                   [&](const fs::path& folder) { fs::remove(folder / name); });
    expect_refused(identities, kUnreadable, name + " is a folder", [&](const fs::path& folder) {
      fs::remove(folder / name);
      fs::create_directory(folder / name);
    });
    expect_refused(identities, kNotBelieved, name + " cut off",
                   [&](const fs::path& folder) { fs::resize_file(folder / name, 100); });
    expect_refused(identities, kNotBelieved, name + " empty",
                   [&](const fs::path& folder) { fs::resize_file(folder / name, 0); });
    expect_refused(identities, kNotBelieved, name + " of others", [&](const fs::path& folder) {
      fs::copy(others.folder() / "service" / name, folder / name, fs::copy_options::overwrite_existing);
    });
  }
  expect_refused(identities, kNotBelieved, "unsigned governance", [&](const fs::path& folder) {
    fs::copy(fs::path(LANELOOM_SOURCE_DIR) / "config/security/governance.xml", folder / "governance.p7s",
             fs::copy_options::overwrite_existing);
  });
  expect_refused(identities, kNotBelieved, "altered governance", [](const fs::path& folder) {
    replace_in(folder / "governance.p7s", "access_control>true", "access_control>false");
  });
  expect_refused(identities, kNotBelieved, "permissions of another identity", [&](const fs::path& folder) {
    fs::copy(identities.folder() / "pnc/permissions.p7s", folder / "permissions.p7s",
             fs::copy_options::overwrite_existing);
  });
  expect_refused(identities, kUnreadable, "no folder",
                 [](const fs::path& folder) { fs::remove_all(folder); });
}

TEST(Identities, TheFileThatIsNotBelievedIsNamed) {
  const Identities identities, others;
  const auto exchanged = [&](const std::string& name, const std::string& reason) {
    const auto exchange = [&](const fs::path& folder) {
      fs::copy(others.folder() / "service" / name, folder / name, fs::copy_options::overwrite_existing);
    };
    expect_refused(identities, kNotBelieved, name, exchange, "dds.security_directory: " + reason);
  };
  exchanged("cert.pem", "cert.pem: ");
  exchanged("key.pem", "key.pem is not the key of cert.pem");
  exchanged("permissions.p7s", "permissions.p7s: ");
  exchanged("governance.p7s", "governance.p7s: ");
  expect_refused(
      identities, kNotBelieved, "cut off",
      [](const fs::path& folder) { fs::resize_file(folder / "governance.p7s", 100); },
      "governance.p7s is not signed, or cut off");
  expect_refused(
      identities, kNotBelieved, "of another identity",
      [&](const fs::path& folder) {
        fs::copy(identities.folder() / "pnc/permissions.p7s", folder / "permissions.p7s",
                 fs::copy_options::overwrite_existing);
      },
      "not permitted to the identity, in ");
}

TEST(Identities, AFolderThatIsInOrderIsValid) {
  const Identities identities;
  const Service service(identities.as("service", private_config()));
  Process check(command(private_config(), {"--config", service.path, "--check-config"}));
  EXPECT_EQ(check.wait(), 0) << check.errors();
}

TEST(Identities, OtherDomainsAreClosed) {
  const Identities identities({}, {"--domains", "200-232"});
  Service service(identities.as("service", private_config()));
  EXPECT_EQ(service.wait(), kNotBelieved) << service.errors();
}

TEST(Identities, AreReadAgainAtAReload) {
  const auto config = private_config();
  const Identities identities;
  Service service(identities.as("service", config));
  Listener<PublishedMap> maps(identities.as("pnc", config));
  ASSERT_TRUE(maps.wait_for([](const PublishedMap&) { return true; })) << service.errors();
  const fs::path folder = identities.folder() / "service", intact = identities.folder() / "intact";
  fs::copy(folder, intact);
  fs::remove(folder / "governance.p7s");
  service.signal(SIGHUP);
  EXPECT_TRUE(
      service.wait_for_error("error event=reopening_refused reason=\"dds.security_directory: cannot read " +
                             (folder / "governance.p7s").string()))
      << service.errors();
  maps.forget();
  EXPECT_TRUE(maps.wait_for([](const PublishedMap&) { return true; })) << "it did not go on";

  // So it is with what DDS does not believe, or what does not permit a service to do its work.
  const auto goes_on_without = [&](const std::string& entity) {
    const std::uint64_t session = maps.samples().back().session_id;
    const std::uint64_t newest = maps.samples().back().sequence;
    service.signal(SIGHUP);
    EXPECT_TRUE(
        service.wait_for_error("error event=reopening_refused reason=\"DDS refused to make a " + entity))
        << service.errors();
    EXPECT_TRUE(maps.wait_for([&](const PublishedMap& map) { return map.sequence > newest + 5; }));
    EXPECT_EQ(maps.samples().back().session_id, session);
  };
  fs::copy(fs::path(LANELOOM_SOURCE_DIR) / "config/security/governance.xml", folder / "governance.p7s");
  goes_on_without("participant");
  fs::remove_all(folder);
  fs::copy(identities.folder() / "perception", folder);
  goes_on_without("writer of laneloom/v3/lane_map");

  fs::remove_all(folder);
  fs::copy(intact, folder);
  service.signal(SIGHUP);
  EXPECT_TRUE(service.wait_for_error("event=reopened")) << service.errors();
}

TEST(Identities, ServeTheTools) {
  const auto config = private_config();
  const Identities identities;
  const auto tool = [&](const std::vector<std::string>& words) {
    std::vector<std::string> command{LANELOOM};
    command.insert(command.end(), words.begin(), words.end());
    for (const auto& word : {std::string("--domain"), std::to_string(config.domain),
                             std::string("--vehicle-id"), config.vehicle_id})
      command.push_back(word);
    return command;
  };
  const auto folder = [&](const char* identity) { return (identities.folder() / identity).string(); };
  const Service service(identities.as("service", config));
  const Process publisher(
      tool({"publish", "--scenario", "straight", "--loop", "--security", folder("simulator")}));
  Process stranger(tool({"pnc", "--duration", "10"}));
  Process planner(tool({"pnc", "--duration", "20", "--require-lanes", "--security", folder("pnc")}));
  Process recorder(tool({"record", "--duration", "5", "--out", identities.folder() / "drive.mcap",
                         "--security", folder("observer")}));
  EXPECT_EQ(planner.wait(), 0) << planner.errors() << publisher.errors();
  EXPECT_EQ(stranger.wait(), 3) << "laneloom pnc did hear a map";
  EXPECT_EQ(recorder.wait(), 0) << recorder.errors();
}

TEST(MakeCertificates, WritesNothingOverAndAddsToWhatIsThere) {
  const Identities identities({}, {"service"});
  const auto tool = std::string(LANELOOM_SOURCE_DIR) + "/tools/make-certificates";
  const auto before = text_of(identities.folder() / "service/cert.pem");
  Process again({tool, "--out", identities.folder(), "pnc", "service"});
  EXPECT_EQ(again.wait(), 1);
  EXPECT_NE(again.errors().find("service exists already"), std::string::npos) << again.errors();
  EXPECT_EQ(text_of(identities.folder() / "service/cert.pem"), before);
  EXPECT_FALSE(fs::exists(identities.folder() / "pnc"));

  Process more({tool, "--out", identities.folder(), "pnc"});
  EXPECT_EQ(more.wait(), 0) << more.errors();
  for (const auto& file : fs::directory_iterator(identities.folder() / "pnc"))
    EXPECT_EQ(file.status().permissions(), fs::perms::owner_read | fs::perms::owner_write) << file.path();
  EXPECT_EQ(text_of(identities.folder() / "pnc/identity_ca.cert.pem"),
            text_of(identities.folder() / "service/identity_ca.cert.pem"));
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"nobody"},
                                                {"--domains", "5-233"},
                                                {"--days", "0"},
                                                {"../permissions/service"},
                                                {"--nonsense"}}) {
    std::vector<std::string> command{tool, "--out", identities.folder()};
    command.insert(command.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(Process(command).wait(), 1) << wrong[0];
  }
}

}  // namespace
}  // namespace laneloom
