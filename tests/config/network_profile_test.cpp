#include "config/network_profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::config {
namespace {

using testing::EndsWith;

class NetworkProfileFile : public ::testing::Test {
 protected:
  NetworkProfiles load(const std::string& text) {
    std::ofstream(path_) << text;
    return load_network_profiles(path_);
  }
  std::string error_of(const std::string& text) {
    return thrown_by<ConfigError>([&] { load(text); });
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_.file("profile.yaml");
};

TEST_F(NetworkProfileFile, ReadsBackWhatItWrote) {
  const NetworkProfiles profiles{
      {"front: camera", {{"pitch_gain", {0.875, 12.5}}, {"alignment_gain", {0.25, 300}}}},
      {"", {{"stddev_at_8_m", {0.03125, 50}}}}};
  EXPECT_EQ(load(dump(profiles)), profiles);
}

TEST_F(NetworkProfileFile, AnEmptyPathIsNoProfile) { EXPECT_TRUE(load_network_profiles("").empty()); }

TEST_F(NetworkProfileFile, TellsWhereItIsWrong) {
  EXPECT_THAT(error_of("a: {b: {value: 1, weight: 0}}"), EndsWith("1: a.b.weight is not above 0"));
  EXPECT_THAT(error_of("a:\n  b: {value: 1}"), EndsWith("2: a.b.weight is not above 0"));
  EXPECT_THAT(error_of("a: {b: {value: x, weight: 1}}"), EndsWith("1: a.b.value is not a finite number"));
  EXPECT_THAT(error_of("a: {b: {value: .nan, weight: 1}}"), EndsWith("1: a.b.value is not a finite number"));
  EXPECT_THAT(error_of("a: {b: {value: [1], weight: 1}}"), EndsWith("1: a.b.value is not a finite number"));
  EXPECT_THAT(error_of("a: {b: {value: -1e10, weight: 1}}"), EndsWith("1: a.b.value is beyond 1e9"));
  EXPECT_THAT(error_of("a: {b: {value: 1, weight: 1e160}}"), EndsWith("1: a.b.weight is beyond 1e9"));
  EXPECT_THAT(error_of("a: {b: {mean: 1, weight: 1}}"), EndsWith("1: a.b.mean is not a known key"));
  EXPECT_THAT(error_of("a: {b: {value: 1, value: 2, weight: 1}}"),
              EndsWith("1: value is given twice in a.b"));
  EXPECT_THAT(error_of("a: 1"), EndsWith("1: a is not a map of keys and values"));
  EXPECT_THAT(error_of("- a"), EndsWith("1: the profile is not a map of keys and values"));
  EXPECT_THAT(error_of(""), EndsWith("1: the profile is not a map of keys and values"));
  EXPECT_THAT(error_of("a: {b: "), testing::HasSubstr("bad YAML"));
}

TEST_F(NetworkProfileFile, AFileThatIsNotThereIsNamed) {
  std::filesystem::remove(path_);
  EXPECT_THROW(load_network_profiles(path_), ConfigError);
}

TEST_F(NetworkProfileFile, OfManyDrivesIsReadBack) {
  const NetworkProfiles drive{{"front", {{"a", {0.5, 6e8}}}}};
  std::ofstream(path_) << dump(merged(std::vector{drive, drive}));
  EXPECT_EQ(load_network_profiles(path_).at("front").at("a"), (LearnedValue{0.5, 1e9}));
}

TEST(MergedProfiles, HaveTheMeanByWeightOfEachValue) {
  const std::vector<NetworkProfiles> of_drives{
      {{"front", {{"a", {1.0, 10.0}}, {"b", {5.0, 2.0}}}}},
      {{"front", {{"a", {4.0, 20.0}}}}, {"rear", {{"a", {7.0, 1.0}}}}}};
  const NetworkProfiles all = merged(of_drives);
  EXPECT_DOUBLE_EQ(all.at("front").at("a").value, 3.0);
  EXPECT_DOUBLE_EQ(all.at("front").at("a").weight, 30.0);
  EXPECT_EQ(all.at("front").at("b"), (LearnedValue{5.0, 2.0}));
  EXPECT_EQ(all.at("rear").at("a"), (LearnedValue{7.0, 1.0}));
  EXPECT_TRUE(merged({}).empty());
}

}  // namespace
}  // namespace laneloom::config
