#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "config/config_file.hpp"
#include "mapping/shapes.hpp"
#include "recording/allocations.hpp"
#include "sd_map/osm.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::sd_map {
namespace {

using test::straight;
using ::testing::HasSubstr;
using Verdict = SdMap::Verdict;

/// About (48, 9): nodes on a cross, whose arms are about 111 m (latitude) and 74 m (longitude) long.
const std::string kNodes = R"(
  <node id="1" lat="48.000" lon="8.999"/> <node id="5" lat="48.000" lon="9.000"/>
  <node id="3" lat="48.000" lon="9.001"/> <node id="4" lat="48.001" lon="9.000"/>)";
const std::string kMain =
    R"(<way id="10"><nd ref="1"/><nd ref="5"/><nd ref="3"/><tag k="highway" v="primary"/></way>)";

/// A way from the crossing to the north.
std::string side(const std::string& highway, const std::string& oneway = "no") {
  return R"(<way id="20"><nd ref="5"/><nd ref="4"/><tag k="highway" v=")" + highway +
         R"("/><tag k="oneway" v=")" + oneway + R"("/></way>)";
}

class OsmFile : public ::testing::Test {
 protected:
  SdMap read(const std::string& elements) {
    std::ofstream(config_.file) << "<osm version=\"0.6\">" << elements << "</osm>";
    return load_sd_map(config_);
  }
  std::string complaint(const std::string& elements) {
    return thrown_by([&] { read(elements); });
  }

  const TemporaryFolder folder_;
  SdMapConfig config_{
      .file = folder_.file("map.osm"), .origin_latitude_deg = 48.0, .origin_longitude_deg = 9.0};
  const Polyline from_west_ = straight({-30, -2, 0}, {-10, -2, 0}),
                 to_north_ = straight({2, 10, 0}, {2, 30, 0}),
                 from_north_ = straight({-2, 30, 0}, {-2, 10, 0}),
                 to_west_ = straight({-10, 2, 0}, {-30, 2, 0});
};

TEST_F(OsmFile, GivesStreetsInTheMapFrame) {
  const SdMap map = read(kNodes + kMain + side("residential"));
  EXPECT_EQ(map.verdict(from_west_, to_north_), Verdict::connected);
  EXPECT_EQ(map.verdict(from_north_, to_west_), Verdict::connected);
  EXPECT_EQ(map.verdict(straight({-200, 0, 0}, {-100, 0, 0}), to_north_), Verdict::unknown);
}

TEST_F(OsmFile, ReadsOnewayStreetsEitherWay) {
  EXPECT_EQ(read(kNodes + kMain + side("road", "yes")).verdict(from_north_, to_west_), Verdict::unknown);
  EXPECT_EQ(read(kNodes + kMain + side("road", "-1")).verdict(from_west_, to_north_), Verdict::unknown);
  EXPECT_EQ(read(kNodes + kMain + side("road", "no")).verdict(from_west_, to_north_), Verdict::connected);
}

TEST_F(OsmFile, ReadsTheNumberOfLanes) {
  const auto lanes_with = [&](const std::string& value) {
    const std::string tagged = R"(<tag k="lanes" v=")" + value + R"("/></way>)";
    std::string street = side("residential");
    street.replace(street.find("</way>"), 6, tagged);
    return read(kNodes + street).lanes_at({0, 50}, Eigen::Vector2d::UnitY());
  };
  EXPECT_EQ(lanes_with("3"), 3);
  for (const char* value : {"", "0", "-2", "1.5", "2;3", "1000", "two"})
    EXPECT_EQ(lanes_with(value), 0) << value;
  EXPECT_EQ(read(kNodes + side("residential")).lanes_at({0, 50}, Eigen::Vector2d::UnitY()), 0);
}

TEST_F(OsmFile, ReadsTurnRestrictions) {
  const std::string no_left = R"(<relation id="7">
      <tag k="type" v="restriction"/><tag k="restriction" v="no_left_turn"/>
      <member type="way" role="from" ref="10"/><member type="node" role="via" ref="5"/>
      <member type="way" role="to" ref="20"/></relation>)";
  EXPECT_EQ(read(kNodes + kMain + side("road") + no_left).verdict(from_west_, to_north_), Verdict::forbidden);
}

TEST_F(OsmFile, AForbiddenAboutTurnForbidsNothingElse) {
  const std::string no_u_turn = R"(<relation id="7">
      <tag k="type" v="restriction"/><tag k="restriction" v="no_u_turn"/>
      <member type="way" role="from" ref="10"/><member type="node" role="via" ref="5"/>
      <member type="way" role="to" ref="10"/></relation>)";
  const Polyline to_east = straight({10, -2, 0}, {30, -2, 0});
  EXPECT_EQ(read(kNodes + kMain + side("road") + no_u_turn).verdict(from_west_, to_east), Verdict::connected);
}

TEST_F(OsmFile, LeavesOutPathsAndWhatLiesOutsideOfTheExtract) {
  EXPECT_EQ(read(kNodes + kMain + side("footway")).verdict(from_west_, to_north_), Verdict::unknown);
  const std::string cut =
      R"(<way id="20"><nd ref="99"/><nd ref="5"/><nd ref="4"/><tag k="highway" v="road"/></way>)";
  EXPECT_EQ(read(kNodes + kMain + cut).verdict(from_west_, to_north_), Verdict::connected);
}

TEST(HarbourStreets, LeadIntoAOneWayStreetAndNotOutOfItsBegin) {
  const SdMap map = load_sd_map({.file = LANELOOM_ROADS "/harbour_streets.osm"});
  const Polyline into_junction = straight({20, 1.6, 0}, {50, 1.6, 0}),
                 rope_walk = straight({72, 20, 0}, {72, 40, 0});
  EXPECT_EQ(map.verdict(into_junction, rope_walk), Verdict::connected);
  EXPECT_EQ(map.verdict(straight({72, 40, 0}, {72, 20, 0}), straight({50, -1.6, 0}, {20, -1.6, 0})),
            Verdict::unknown);
}

TEST_F(OsmFile, NamesWhatIsWrong) {
  for (const std::string place : {R"(lat="91" lon="9")", R"(lat="48")", R"(lat="" lon="")"}) {
    const std::string bad = R"(<node id="7" )" + place + "/>";
    const std::string way = R"(<way id="10"><nd ref="1"/><nd ref="7"/><nd ref="3"/>)";
    EXPECT_THAT(complaint(kNodes + bad + way + R"(<tag k="highway" v="primary"/></way>)"),
                HasSubstr("way 10 has node 7, which has no latitude and longitude in degrees"));
    EXPECT_EQ(complaint(kNodes + bad + way + R"(<tag k="power" v="line"/></way>)" + kMain), "")
        << "no street needs it";
  }
  EXPECT_THAT(complaint(kNodes), HasSubstr("no street"));
  EXPECT_THAT(complaint("<unclosed"), HasSubstr(config_.file));
  config_.origin_latitude_deg = -48.0;
  EXPECT_THAT(complaint(kNodes + kMain), HasSubstr("origin"));
}

TEST_F(OsmFile, AFileOfAnotherKindIsToldAsThat) {
  using namespace std::string_view_literals;
  const auto expect_told = [&](std::string_view content, const std::string& kind) {
    std::ofstream(config_.file) << content;
    EXPECT_EQ(thrown_by([&] { load_sd_map(config_); }),
              config_.file + ": " + kind + "; an extract as OSM XML (.osm) is needed");
  };
  expect_told("\x1f\x8b\x08"sv, "is compressed with gzip");
  expect_told("BZh91AY"sv, "is compressed with bzip2");
  expect_told("\0\0\0\x0d\x0a\x09OSMHeader\x18"sv, "is an extract as PBF");
  expect_told(R"({"version": 0.6})"sv, "is JSON");
  expect_told("streets"sv, "is no XML");
  expect_told("<gpx/>"sv, "has no element osm");
  expect_told(""sv, "is empty");
}

TEST_F(OsmFile, TakesLittleMemoryForALongStreet) {
  const std::string ends = R"(<node id="1" lat="48" lon="9"/><node id="2" lat="48.5" lon="9.7"/>)";
  watch_allocations();
  EXPECT_FALSE(
      read(ends + R"(<way id="10"><nd ref="1"/><nd ref="2"/><tag k="highway" v="trunk"/></way>)").empty());
  EXPECT_LT(peak_bytes(), 5'000'000U);
}

TEST_F(OsmFile, RefusesMoreStreetsThanMemoryHolds) {
  const std::string ends =
      R"(<node id="1" lat="44" lon="9"/><node id="2" lat="52" lon="9"/>)";  // 889 km apart
  std::string way = R"(<way id="10"><tag k="highway" v="trunk"/>)";
  for (int i = 0; i < 12; ++i) way += R"(<nd ref="1"/><nd ref="2"/>)";
  EXPECT_THAT(complaint(ends + way + "</way>"), HasSubstr("more than 20000 km"));
}

TEST_F(OsmFile, RefusesWhatIsNoFileAndWhatIsTooLarge) {
  ASSERT_EQ(mkfifo(config_.file.c_str(), 0600), 0);
  EXPECT_THROW(load_sd_map(config_), ConfigError) << "or waits for ever";
  std::filesystem::remove(config_.file);
  std::ofstream(config_.file).close();
  std::filesystem::resize_file(config_.file, (128U << 20U) + 1U);  // takes no space
  watch_allocations();
  EXPECT_THROW(load_sd_map(config_), ConfigError);
  EXPECT_LT(peak_bytes(), 5'000'000U);
}

TEST_F(OsmFile, WithoutAFileThereIsNone) {
  EXPECT_TRUE(load_sd_map({}).empty());
  config_.file += ".missing";
  EXPECT_THROW(load_sd_map(config_), std::runtime_error);
}

}  // namespace
}  // namespace laneloom::sd_map
