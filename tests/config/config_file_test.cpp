#include "config/config_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

#include "temporary_folder.hpp"

namespace laneloom::config {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::filesystem::path kConfigDir = LANELOOM_CONFIG_DIR;

class ConfigFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    const auto path = folder_.file("laneloom.yaml");
    std::ofstream(path) << text;
    return path;
  }
  /// The complaint about a file with this text, without the file's name.
  std::string error_of(const std::string& text) {
    const auto path = write(text);
    try {
      load_config(path);
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), StartsWith(path));
      return std::string(error.what()).substr(path.size());
    }
    return "no error";
  }

 private:
  const TemporaryFolder folder_;
};

TEST_F(ConfigFile, MissingKeysKeepTheirDefaults) {
  const auto config =
      load_config(write("mapper:\n  lane:\n    min_width_m: 2.25\ndds:\n  vehicle_id: car-7\n"));
  EXPECT_EQ(config.mapper.lane.min_width_m, 2.25);
  EXPECT_EQ(config.dds.vehicle_id, "car-7");
  Config expected;
  expected.mapper.lane.min_width_m = 2.25;
  expected.dds.vehicle_id = "car-7";
  EXPECT_EQ(dump(config), dump(expected));
}

TEST_F(ConfigFile, ASecondDocumentIsNotPassedOver) {
  EXPECT_THAT(error_of("dds:\n  domain: 3\n---\ndds:\n  vehicle_id: car-7\n"),
              HasSubstr("begins a second document"));
  EXPECT_EQ(load_config(write("---\ndds:\n  domain: 3\n")).dds.domain, 3);
}

// YAML::LoadAll() of yaml-cpp 0.7 takes it for documents without end.
TEST_F(ConfigFile, ATextThatBeginsWithACommaIsRefused) {
  EXPECT_THAT(error_of(", dds:\n  domain: 3\n"), HasSubstr("outside of its document"));
}

TEST_F(ConfigFile, AnEmptyFileIsTheDefaults) {
  EXPECT_EQ(dump(load_config(write("# nothing\n"))), dump(Config{}));
}

TEST_F(ConfigFile, ADumpReadsBackUnchanged) {
  Config config;
  config.mapper.range.forward_max_m = 31.1;
  config.mapper.preprocess.reject_zigzag = false;
  config.mapper.voxel_map.min_detections = 3;
  config.dds.transport = "udp+shm";
  config.dds.profile_file = "it's a file.xml";
  config.dds.profile_name = "p";
  EXPECT_EQ(dump(load_config(write(dump(config)))), dump(config));
}

TEST_F(ConfigFile, AnUnknownKeyIsNamedWithItsLine) {
  EXPECT_EQ(error_of("mapper:\n  lane:\n    min_width_m: 2\n    min_widht_m: 3\n"),
            ":4: mapper.lane.min_widht_m: is not a known key");
  EXPECT_EQ(error_of("\nlanes: {}\n"), ":2: lanes: is not a known key");
}

TEST_F(ConfigFile, ARepeatedKeyIsNamedWithItsLine) {
  EXPECT_EQ(error_of("sync:\n  max_wait_s: 1\n  max_wait_s: 1\n"), ":3: sync.max_wait_s: is given twice");
  EXPECT_EQ(error_of("sync:\n  max_wait_s: 1\nsync:\n  queue_capacity: 4\n"), ":3: sync: is given twice");
}

TEST_F(ConfigFile, AWrongTypeIsNamedWithItsLine) {
  EXPECT_EQ(error_of("sync:\n  max_wait_s: soon\n"), ":2: sync.max_wait_s: is not a number in s");
  EXPECT_EQ(error_of("sync:\n  queue_capacity: 1.5\n"),
            ":2: sync.queue_capacity: is not a whole number in frames");
  EXPECT_EQ(error_of("sync:\n  queue_capacity: 99999999999\n"),
            ":2: sync.queue_capacity: is not a whole number in frames");
  EXPECT_EQ(error_of("sync:\n  max_wait_s: [1]\n"), ":2: sync.max_wait_s: is not a number in s");
  EXPECT_EQ(error_of("sync:\n  max_wait_s:\n"), ":2: sync.max_wait_s: is not a number in s");
  EXPECT_EQ(error_of("mapper:\n  preprocess:\n    reject_zigzag: 2\n"),
            ":3: mapper.preprocess.reject_zigzag: is not true or false");
  EXPECT_EQ(error_of("sync: 3\n"), ":1: sync: is not a map of keys and values");
  EXPECT_EQ(error_of("[1, 2]\n"), ":1: is not a map of keys and values");
}

TEST_F(ConfigFile, AValueOutOfRangeIsNamedWithItsLine) {
  EXPECT_EQ(error_of("service:\n\n  tick_rate_hz: 0\n"), ":3: service.tick_rate_hz: 0 is not in 8 .. 100");
  // Two periods are longer than the map's deadline.
  EXPECT_EQ(error_of("service:\n  tick_rate_hz: 7.9\n"), ":2: service.tick_rate_hz: 7.9 is not in 8 .. 100");
  EXPECT_THAT(error_of("service:\n  tick_rate_hz: .nan\n"),
              HasSubstr(":2: service.tick_rate_hz: nan is not in"));
  EXPECT_THAT(error_of("service:\n  tick_rate_hz: .inf\n"),
              HasSubstr(":2: service.tick_rate_hz: inf is not in"));
  EXPECT_EQ(error_of("dds:\n  transport: tcp\n"), ":2: dds.transport: \"tcp\" is none of udp|udp+shm");
  EXPECT_THAT(error_of("dds:\n  transport: udp|udp+shm\n"), HasSubstr("is none of"));
  EXPECT_THAT(error_of("dds:\n  vehicle_id: 'car*'\n"),
              HasSubstr(":2: dds.vehicle_id: \"car*\" is not 1 to 64"));
  EXPECT_THAT(error_of("dds:\n  vehicle_id: ''\n"), HasSubstr(":2: dds.vehicle_id: \"\" is not 1 to 64"));
}

TEST_F(ConfigFile, AContradictionIsNamedWithItsLine) {
  EXPECT_EQ(error_of("mapper:\n  range:\n    forward_min_m: 40\n"),
            ":3: mapper.range.forward_min_m: must be less than forward_max_m");
  EXPECT_EQ(error_of("mapper:\n  fusion:\n    birth_log_odds: -5\n"),
            ":3: mapper.fusion.birth_log_odds: must not be below min_log_odds, or nothing is mapped");
  EXPECT_EQ(error_of("mapper:\n  fusion:\n    extension_log_odds: -5\n"),
            ":3: mapper.fusion.extension_log_odds: must not be below min_log_odds, or no line grows");
  EXPECT_EQ(error_of("mapper:\n  lane:\n    min_width_m: 4.5\n"),
            ":3: mapper.lane.min_width_m: must be less than max_width_m");
  EXPECT_EQ(error_of("mapper:\n  lane:\n    assumed_width_m: 2\n"),
            ":3: mapper.lane.assumed_width_m: must be from min_width_m to max_kerb_width_m, or "
            "one_sided_lanes false");
  EXPECT_EQ(error_of("service:\n  degraded_after_s: 0.5\n"),
            ":2: service.degraded_after_s: must not exceed stale_after_s");
  EXPECT_EQ(error_of("dds:\n  profile_file: x.xml\n"),
            ":2: dds.profile_file: profile_file and profile_name are given together or not at all");
  for (const std::string name : {"body", "base_link"})
    EXPECT_EQ(error_of("dds:\n  map_frame_id: " + name + "\n"),
              ":2: dds.map_frame_id: \"" + name + "\" names the frame of the vehicle");
  // The key at fault need not be in the file.
  EXPECT_EQ(error_of("service:\n  stale_after_s: 0.1\n"),
            ": service.degraded_after_s: must not exceed stale_after_s");
}

TEST_F(ConfigFile, LinesOfMorePointsThanAMessageHoldsAreAContradiction) {
  EXPECT_THAT(error_of("mapper:\n  lane:\n    step_m: 0.1\n"),
              StartsWith(":3: mapper.lane.step_m: must exceed 0.12"));
  EXPECT_EQ(error_of("mapper:\n  lane:\n    step_m: 0.2\n"), "no error");
  const std::string far =
      "mapper:\n  range:\n    forward_max_m: 100\n  fusion:\n    station_spacing_m: 0.2\n";
  EXPECT_THAT(error_of(far), StartsWith(":5: mapper.fusion.station_spacing_m: must exceed 0.22"));
  EXPECT_EQ(error_of(far + "  method: voxels\n"), "no error");
  EXPECT_THAT(error_of("mapper:\n  range:\n    side_max_m: 200\n  lane:\n    step_m: 0.5\n"),
              StartsWith(":5: mapper.lane.step_m: must exceed 0.6"));

  std::ostringstream idl;
  idl << std::ifstream(kConfigDir / "../idl/Common.idl").rdbuf();
  EXPECT_THAT(idl.str(), HasSubstr("MAX_POINTS = 1024;"));
}

TEST_F(ConfigFile, ANameThatRos2RefusesIsNamedWithItsLine) {
  for (const std::string name : {"/car_1", "car_1", "/fleet/car_1", "_c", ""})
    EXPECT_EQ(error_of("ros2:\n  namespace: '" + name + "'\n"), "no error") << name;
  for (const std::string name : {"/", "car-1", "/car_1/", "//car", "a//b", "1car", "/a/1", "a b", "rt/ö"})
    EXPECT_THAT(error_of("ros2:\n  namespace: '" + name + "'\n"), StartsWith(":2: ros2.namespace: \"" + name))
        << name;
  for (const std::string key : {"odometry_topic", "objects_topic", "road_segments_topic"}) {
    EXPECT_THAT(error_of("ros2:\n  " + key + ": ''\n"), StartsWith(":2: ros2." + key + ": \"\" is no name"));
    EXPECT_EQ(error_of("ros2:\n  " + key + ": " + std::string(100, 'a') + "\n"), "no error");
    EXPECT_THAT(error_of("ros2:\n  " + key + ": " + std::string(101, 'a') + "\n"),
                StartsWith(":2: ros2." + key));
  }
  EXPECT_THAT(error_of("ros2:\n  distro: foxy\n"), HasSubstr("\"foxy\" is none of humble|jazzy"));
}

TEST_F(ConfigFile, TwoTopicsOfRos2WithOneNameAreRefused) {
  EXPECT_EQ(error_of("ros2:\n  odometry_topic: odom\n  objects_topic: odom\n"),
            ":3: ros2.objects_topic: \"odom\" is the name of another topic of the service");
  for (const std::string ros_namespace : {"", "car_1", "/car_1"}) {
    const std::string inner = ros_namespace.empty() ? "/" : "/car_1/";
    const auto begin = "ros2:\n  namespace: '" + ros_namespace + "'\n  ";
    EXPECT_THAT(error_of(begin + "odometry_topic: x\n  road_segments_topic: " + inner + "x\n"),
                StartsWith(":4: ros2.road_segments_topic"));
    for (const std::string key : {"odometry_topic", "objects_topic", "road_segments_topic"})
      for (const std::string name : {"laneloom/detections", "laneloom/lane_map", "laneloom/markers"}) {
        EXPECT_THAT(error_of(begin + key + ": " + name + "\n"), StartsWith(":3: ros2." + key)) << name;
        EXPECT_THAT(error_of(begin + key + ": " + inner + name + "\n"), StartsWith(":3: ros2." + key))
            << name;
      }
    EXPECT_THAT(error_of(begin + "objects_topic: /diagnostics\n"), StartsWith(":3: ros2.objects_topic"));
  }
  EXPECT_EQ(error_of("ros2:\n  namespace: car_1\n  objects_topic: /odom\n"), "no error");
  EXPECT_EQ(error_of("ros2:\n  namespace: car_1\n  objects_topic: diagnostics\n"), "no error");
}

TEST_F(ConfigFile, BadYamlIsNamedWithItsLine) {
  EXPECT_THAT(error_of("sync:\n  max_wait_s: [1\n"), ::testing::MatchesRegex(":[0-9]+: bad YAML: .*"));
  EXPECT_THAT(error_of("sync:\n\tmax_wait_s: 1\n"), HasSubstr("bad YAML"));
  EXPECT_NE(error_of(std::string(100000, '[')), "no error");
}

TEST_F(ConfigFile, AnUnreadableFileIsNamed) {
  EXPECT_THROW(load_config("/nonexistent/laneloom.yaml"), ConfigError);
  EXPECT_THROW(load_config("/"), ConfigError);
  EXPECT_THAT(error_of(std::string(2 << 20, ' ')), HasSubstr("is too large"));
}

TEST(Validate, TheDefaultsAreValid) { EXPECT_NO_THROW(validate(Config{})); }

TEST(Validate, RefusesWhatWasSetInCode) {
  Config config;
  config.mapper.voxel_map.voxel_size_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(validate(config), ConfigError);
}

TEST(Settings, ReadBackAsTheConfigurationThatTheyAreOf) {
  Config config;
  config.mapper.range.side_max_m = 20.5;
  config.dds.vehicle_id = "7";
  config.dds.profile_file = "/etc/a: 'b', {c}.xml";  // the two are valid together alone
  config.dds.profile_name = "planner";
  config.service.snapshot_file = "";
  EXPECT_EQ(settings(from_settings(settings(config), "a status")), settings(config));
  EXPECT_EQ(settings(from_settings({}, "a status")), settings(Config{}));
}

TEST(Settings, AreRefusedWhereTheyAreNone) {
  const auto complaint = [](const std::vector<std::pair<std::string, std::string>>& told) {
    try {
      from_settings(told, "a status");
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint({{"mapper.unheard_of", "1"}}), "a status: mapper.unheard_of: is not a known key");
  EXPECT_THAT(complaint({{"mapper.range.side_max_m", "wide"}}), HasSubstr("is not a number"));
  EXPECT_THAT(complaint({{"mapper", "1"}, {"mapper.method", "lines"}}), HasSubstr("a status: mapper"));
  EXPECT_THAT(complaint({{"dds.profile_file", "x"}}), HasSubstr("given together"));
  EXPECT_NE(complaint({{"", ""}}), "");
  EXPECT_NE(complaint({{"..", "1"}}), "");
}

TEST(SetValue, ChangesOneValueOfAny) {
  Config config;
  set_value(config, "mapper.range.side_max_m=20.5");
  set_value(config, "mapper.method=voxels");
  set_value(config, "dds.vehicle_id=car7");
  EXPECT_EQ(config.mapper.range.side_max_m, 20.5);
  EXPECT_EQ(config.mapper.method, FusionMethod::voxels);
  EXPECT_EQ(config.dds.vehicle_id, "car7");
  EXPECT_EQ(config.mapper.range.forward_max_m, Config{}.mapper.range.forward_max_m);
}

TEST(SetValue, RefusesWhatAFileMayNotSayAndChangesNothing) {
  Config config;
  for (const char* assignment :
       {"mapper.range.side_max_m", "mapper.range.width=3", "mapper.range.side_max_m=wide",
        "mapper.range.side_max_m=-1", "=3", "mapper=3", "mapper.range.side_max_m=[1, 2", ".=1"}) {
    EXPECT_THROW(set_value(config, assignment), ConfigError) << assignment;
    EXPECT_EQ(dump(config), dump(Config{})) << assignment;
  }
}

// The mapper divides by these limits.
TEST(SetValue, RefusesLimitsThatLeaveNothing) {
  Config config;
  for (const char* assignment : {"mapper.lane.min_length_m=0.4", "mapper.linkage.max_angle_deg=0",
                                 "mapper.linkage.max_shared_gap_m=0.9", "mapper.linkage.max_gap_m=1.9",
                                 "mapper.linkage.max_lateral_m=0"})
    EXPECT_THROW(set_value(config, assignment), ConfigError) << assignment;
}

TEST(Presets, SetRangeAndAlpha) {
  Config config;
  config.mapper.lane.min_width_m = 2.0;
  apply_preset(config, "av2");
  EXPECT_EQ(config.mapper.range.forward_min_m, -30.0);
  EXPECT_EQ(config.mapper.range.forward_max_m, 20.0);
  EXPECT_EQ(config.mapper.range.side_max_m, 15.0);
  EXPECT_EQ(config.mapper.voxel_map.min_detections, 3);
  EXPECT_EQ(config.mapper.lane.min_width_m, 2.0);
  apply_preset(config, "inhouse");
  EXPECT_EQ(config.mapper.range.forward_min_m, -5.0);
  EXPECT_EQ(config.mapper.range.forward_max_m, 30.0);
  EXPECT_EQ(config.mapper.voxel_map.min_detections, 10);
  EXPECT_THROW(apply_preset(config, "nuscenes"), ConfigError);
}

TEST(ConfigHash, NamesTheValues) {
  Config config;
  const auto hash = config_hash(config);
  EXPECT_THAT(hash, ::testing::MatchesRegex("[0-9a-f]{16}"));
  EXPECT_EQ(config_hash(Config{}), hash);
  config.mapper.stopline.max_gap_m += 1e-9;
  EXPECT_NE(config_hash(config), hash);
}

TEST(ChangedKeys, NamesEachKeyWhoseValueDiffers) {
  EXPECT_THAT(changed_keys(Config{}, Config{}), ::testing::IsEmpty());
  Config config;
  config.mapper.preprocess.reject_zigzag = !config.mapper.preprocess.reject_zigzag;
  config.mapper.stopline.max_gap_m += 1e-9;
  config.sync.queue_capacity += 1;
  config.service.log_level = "off";
  config.dds.vehicle_id = "car";
  config.dds.profile_file = "profile.xml";
  EXPECT_THAT(changed_keys(Config{}, config),
              ::testing::ElementsAre("mapper.preprocess.reject_zigzag", "mapper.stopline.max_gap_m",
                                     "sync.queue_capacity", "service.log_level", "dds.vehicle_id",
                                     "dds.profile_file"));
}

/// The lines that are no comments.
std::set<std::string> settings_in(std::istream&& text) {
  std::set<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    const auto start = line.find_first_not_of(' ');
    if (start != std::string::npos && line[start] != '#') lines.insert(line);
  }
  return lines;
}

TEST(ShippedFiles, LaneloomYamlHasDefaultsWithTheirUnitsAndRanges) {
  const auto shipped = settings_in(std::ifstream(kConfigDir / "laneloom.yaml"));
  EXPECT_GT(shipped.size(), 25U);
  EXPECT_TRUE(std::ranges::includes(settings_in(std::istringstream(dump(Config{}))), shipped));
}

// Whether the number fits with those of other keys is another matter.
TEST(Dump, WritesNumbersAsTheLoaderTakesThem) {
  Config config;
  config.sync.pose_queue_capacity = 100'000;
  EXPECT_THAT(dump(config), HasSubstr("pose_queue_capacity: 100000  # "));
  std::size_t ranges = 0;
  std::istringstream text(dump(config));
  for (std::string line; std::getline(text, line);) {
    const std::smatch match = [&] {
      std::smatch found;
      std::regex_search(line, found, std::regex(R"(# (?:[^,]*, )?(\S+) \.\. (\S+)$)"));
      return found;
    }();
    if (match.empty()) continue;
    ++ranges;
    for (const std::size_t end : {1U, 2U})
      EXPECT_THAT(match[end].str(), ::testing::MatchesRegex("-?[0-9]+(\\.[0-9]+)?")) << line;
  }
  EXPECT_GT(ranges, 80U);
  set_value(config, "sync.pose_queue_capacity=100000");
}

TEST(Dump, SaysWhatEveryKeyMeans) {
  std::istringstream text(dump(Config{}));
  std::string before;
  for (std::string line; std::getline(text, line); before = line) {
    const auto start = line.find_first_not_of(' ');
    if (start == std::string::npos || line[start] == '#') continue;
    EXPECT_NE(before.find("# "), std::string::npos) << line;
  }
}

/// The keys ("section.key") that a file sets.
std::set<std::string> keys_in(std::istream&& text) {
  std::set<std::string> keys;
  std::vector<std::string> path;
  for (std::string line; std::getline(text, line);) {
    const auto start = line.find_first_not_of(' ');
    if (start == std::string::npos || line[start] == '#') continue;
    const auto colon = line.find(':');
    path.resize(start / 2);
    path.push_back((path.empty() ? "" : path.back() + ".") + line.substr(start, colon - start));
    if (colon + 1 < line.size()) keys.insert(path.back());
  }
  return keys;
}

/// The keys, and sections of keys, that a text in Markdown names.
std::set<std::string> keys_named(const std::string& text) {
  static const std::regex kKey(
      "`((?:mapper|sd_map|sync|gate|service|dds|ros2)(?:\\.[a-z0-9_]*[a-z0-9])+|ros2)[`: ]");
  std::set<std::string> keys;
  for (std::sregex_iterator at(text.begin(), text.end(), kKey); at != std::sregex_iterator(); ++at)
    keys.insert((*at)[1]);
  return keys;
}

/// Whether a name is this key, or a section that the key is in.
bool covers(const std::string& name, const std::string& key) {
  return key == name || key.starts_with(name + ".");
}

TEST(ShippedFiles, ThePageTellsOfTheKeysOfLaneloomYaml) {
  std::ifstream page(kConfigDir / "README.md");
  std::string first_columns;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) inside = line == "## The keys that an operator sets";
    if (inside && line.starts_with("|")) first_columns += line.substr(0, line.find(" | ")) + "\n";
  }
  const auto told = keys_named(first_columns);
  const auto set = keys_in(std::ifstream(kConfigDir / "laneloom.yaml"));
  ASSERT_GT(told.size(), 15U);
  for (const auto& key : set)
    EXPECT_TRUE(std::ranges::any_of(told, [&](const auto& name) { return covers(name, key); })) << key;
  for (const auto& name : told)
    EXPECT_TRUE(std::ranges::any_of(set, [&](const auto& key) { return covers(name, key); })) << name;
}

TEST(ShippedFiles, PagesNameKeysThatAreThere) {
  const auto all = settings(Config{});
  std::size_t named = 0;
  for (const char* page : {"config/README.md", "deploy/README.md", "idl/README.md", "idl/driving.md"}) {
    for (const auto& name : keys_named(content(kConfigDir.parent_path() / page))) {
      ++named;
      EXPECT_TRUE(std::ranges::any_of(all, [&](const auto& setting) { return covers(name, setting.first); }))
          << page << ": " << name;
    }
  }
  EXPECT_GT(named, 40U);
}

TEST(ShippedFiles, PaperYamlPinsThePapersParameters) {
  const auto config = load_config(kConfigDir / "paper.yaml");
  EXPECT_EQ(config.mapper.voxel_map.voxel_size_m, 0.2);
  EXPECT_EQ(config.mapper.voxel_map.min_detections, 10);
  EXPECT_EQ(config.mapper.preprocess.min_confidence, 0.3);
  EXPECT_EQ(config.mapper.clustering.min_probability, 0.6);
  EXPECT_EQ(config.mapper.clustering.min_voxels, 3);
  EXPECT_EQ(config.mapper.clustering.min_ratio, 0.7);
}

TEST(ShippedFiles, PaperYamlHasNothingBeyondThePaper) {
  const MapperConfig mapper = load_config(kConfigDir / "paper.yaml").mapper;
  EXPECT_EQ(mapper.method, FusionMethod::voxels);
  EXPECT_EQ(mapper.lane.method, LaneMethod::paper);
  EXPECT_EQ(mapper.lane.min_width_m, 2.5);
  EXPECT_EQ(mapper.lane.max_width_m, 4.5);
  EXPECT_FALSE(mapper.lane.unmarked_roads);
  EXPECT_FALSE(mapper.linkage.straight_across);
  EXPECT_FALSE(mapper.linkage.turns);
  EXPECT_EQ(mapper.direction.driving_side, DrivingSide::unknown);
}

}  // namespace
}  // namespace laneloom::config
