#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "dds/qos.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

// The settings that follow from dds.security_directory. tests/end_to_end tests what Fast DDS does with them.
namespace laneloom::dds {
namespace {

namespace fs = std::filesystem;

const auto kFiles = {"identity_ca.cert.pem", "permissions_ca.cert.pem", "cert.pem", "key.pem",
                     "governance.p7s",       "permissions.p7s"};

class SecurityFolder : public ::testing::Test {
 protected:
  SecurityFolder() {
    for (const auto* file : kFiles) std::ofstream(folder_ / file) << "not looked into here";
    config_.security_directory = folder_;
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  DdsConfig config_;
};

std::string error_of(const DdsConfig& config) {
  return thrown_by([&] { participant_qos(config, "p"); });
}

TEST_F(SecurityFolder, EachFileHasToBeThere) {
  EXPECT_EQ(error_of(config_), "");
  for (const auto* file : kFiles) {
    fs::rename(folder_ / file, folder_ / "aside");
    EXPECT_EQ(error_of(config_), "dds.security_directory: cannot read " + (folder_ / file).string());
    fs::create_directory(folder_ / file);
    EXPECT_EQ(error_of(config_), "dds.security_directory: cannot read " + (folder_ / file).string());
    fs::remove(folder_ / file);
    fs::rename(folder_ / "aside", folder_ / file);
  }
}

TEST_F(SecurityFolder, IsFoundFromTheWorkingDirectory) {
  config_.security_directory = fs::relative(folder_);
  const auto qos = participant_qos(config_, "p");
  const auto& properties = qos.properties().properties();
  const auto key = std::find_if(properties.begin(), properties.end(), [](const auto& property) {
    return property.name() == "dds.sec.auth.builtin.PKI-DH.private_key";
  });
  ASSERT_NE(key, properties.end());
  const std::string path = key->value().substr(std::string("file://").size());
  EXPECT_TRUE(fs::path(path).is_absolute() && fs::equivalent(path, folder_ / "key.pem")) << path;
}

TEST_F(SecurityFolder, CountsInsteadOfWhatAProfileSays) {
  config_.profile_file = folder_ / "profile.xml";
  config_.profile_name = "open";
  std::ofstream(config_.profile_file)
      << R"(<?xml version="1.0"?><profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
    <participant profile_name="open"><rtps><propertiesPolicy><properties>
      <property><name>dds.sec.auth.plugin</name><value>none</value></property>
      <property><name>other</name><value>kept</value></property>
    </properties></propertiesPolicy></rtps></participant></profiles>)";
  const auto qos = participant_qos(config_, "p");
  int others = 0, plugins = 0;
  for (const auto& property : qos.properties().properties()) {
    if (property.name() == "other") ++others;
    if (property.name() != "dds.sec.auth.plugin") continue;
    ++plugins;
    EXPECT_EQ(property.value(), "builtin.PKI-DH");
  }
  EXPECT_EQ(others, 1);
  EXPECT_EQ(plugins, 1);
}

}  // namespace
}  // namespace laneloom::dds
