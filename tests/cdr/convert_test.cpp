#include "cdr/convert.hpp"

#include <gtest/gtest.h>
#include <utf8.h>

#include <functional>
#include <limits>
#include <string>

#include "cdr/random_messages.hpp"

namespace laneloom::dds {
namespace {

constexpr unsigned kSeeds = 50;
const double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Message -> plain type -> message: what either direction forgets, is missing at the end.
template <class Plain, class Message>
Message through_plain(const Message& message, const std::string& map_frame_id) {
  Plain plain;
  EXPECT_EQ(from_msg(Message(message), map_frame_id, plain), "");
  Message result;
  EXPECT_EQ(to_msg(plain, map_frame_id, result), 0U);
  return result;
}

/// Why a good message is refused once it is changed. Empty: it is taken.
std::string refusal_of_detections(unsigned seed, const std::function<void(msg::Detections&)>& change) {
  auto message = RandomMessages(seed).detections();
  change(message);
  DetectionFrame frame;
  return std::string(from_msg(std::move(message), "map", frame));
}
std::string refusal_of_a_pose(const std::function<void(msg::VehiclePose&)>& change) {
  auto message = RandomMessages(5).vehicle_pose();
  message.header().frame_id("map");
  change(message);
  VehiclePose pose;
  return std::string(from_msg(message, "map", pose));
}

TEST(Convert, DetectionsSurvive) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    auto message = RandomMessages(seed).detections();
    message.header().frame_id("body");
    EXPECT_TRUE(through_plain<DetectionFrame>(message, "map") == message) << seed;
  }
}

TEST(Convert, VehiclePosesSurvive) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    auto message = RandomMessages(seed).vehicle_pose();
    message.covariance().clear();
    const auto frame = message.header().frame_id().to_string();
    EXPECT_TRUE(through_plain<VehiclePose>(message, frame) == message) << seed;
  }
}

TEST(Convert, ObjectsSurvive) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    auto message = RandomMessages(seed).objects();
    for (const char* frame : {"body", "map"}) {
      message.header().frame_id(frame);
      EXPECT_TRUE(through_plain<TrackedObjects>(message, "map") == message) << seed << frame;
    }
  }
}

TEST(Convert, TurnsSurvive) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    auto message = RandomMessages(seed).next_turn();
    message.header().frame_id("");
    EXPECT_TRUE(through_plain<NextTurn>(message, "map") == message) << seed;
  }
}

TEST(Refuse, TurnsWithNumbersOrKindsThatAreNone) {
  NextTurn turn;
  auto message = RandomMessages(1).next_turn();
  EXPECT_EQ(from_msg(message, "map", turn), "") << "whatever its frame";
  message.distance_m(kNaN);
  EXPECT_EQ(from_msg(message, "map", turn), "not_finite");
  message = RandomMessages(1).next_turn();
  message.turn(static_cast<msg::TurnKind>(77));
  EXPECT_EQ(from_msg(message, "map", turn), "unknown_enum");
}

TEST(Convert, OfTooManyObjectsTheFirstOnesAreSent) {
  TrackedObjects objects;
  objects.objects.resize(msg::MAX_OBJECTS + 3);
  objects.objects.back().id = 7;
  msg::Objects message;
  EXPECT_EQ(to_msg(objects, "map", message), 3U);
  EXPECT_EQ(message.objects().size(), msg::MAX_OBJECTS);
  EXPECT_EQ(message.objects().back().id(), 0U);
}

TEST(Convert, ObjectsAreInTheMapFrameOrInThatOfTheBody) {
  auto message = RandomMessages(1).objects();
  TrackedObjects objects;
  for (const char* frame : {"map", "body", "base_link", ""}) {
    message.header().frame_id(frame);
    EXPECT_EQ(from_msg(message, "map", objects), "");
    EXPECT_EQ(objects.in_map_frame, frame == std::string("map")) << frame;
  }
  for (const char* frame : {"odom", "camera_front", "utm"}) {
    message.header().frame_id(frame);
    EXPECT_EQ(from_msg(message, "map", objects), "wrong_frame") << frame;
  }
  EXPECT_EQ(from_msg(message, "utm", objects), "");
}

TEST(Refuse, ObjectsWithNumbersOrClassesThatAreNone) {
  TrackedObjects objects;
  auto message = RandomMessages(1).objects();
  const std::string frame = message.header().frame_id().to_string();
  message.objects()[0].speed_mps(kNaN);
  EXPECT_EQ(from_msg(message, frame, objects), "not_finite");
  message = RandomMessages(1).objects();
  message.objects()[0].kind(static_cast<msg::ObjectKind>(77));
  EXPECT_EQ(from_msg(message, frame, objects), "unknown_enum");
}

TEST(Convert, RoadMarkingsSurvive) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const auto message = RandomMessages(seed).road_markings();
    EXPECT_TRUE(through_plain<RoadMarkings>(message, "map") == message) << seed;
  }
}

TEST(Convert, LaneMapsSurvive) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const auto message = RandomMessages(seed).lane_map();
    EXPECT_TRUE(through_plain<PublishedMap>(message, "map") == message) << seed;
  }
}

TEST(Convert, StatusSurvives) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    auto message = RandomMessages(seed).service_status();
    message.header().frame_id("");
    EXPECT_TRUE(through_plain<ServiceStatus>(message, "map") == message) << seed;
  }
}

// A round trip does not see what is exchanged in both directions.
TEST(Convert, FieldsKeepTheirMeaning) {
  auto message = RandomMessages(1).lane_map();
  PublishedMap plain;
  ASSERT_EQ(from_msg(message, "map", plain), "");
  EXPECT_EQ(plain.map.stamp_ns, message.header().stamp_ns());
  EXPECT_EQ(plain.sequence, message.header().sequence_number());
  EXPECT_EQ(plain.session_id, message.header().session_id());
  EXPECT_EQ(plain.map.lanes[0].left_borders[0].boundary, message.lanes()[0].left_borders()[0].boundary());
  EXPECT_EQ(plain.map.lanes[0].right_borders[0].on_boundary.to_m,
            message.lanes()[0].right_borders()[0].on_boundary().to_m());
  EXPECT_EQ(plain.map.way->stations[0].right_m, message.way().stations()[0].right_m());
  EXPECT_EQ(plain.map.way->lanes[0].id, message.way().lanes()[0].lane());
  EXPECT_EQ(plain.map.lanes[0].left[0].y(), message.lanes()[0].left()[0].y());
  ASSERT_FALSE(plain.map.lanes[0].right_neighbours.empty());
  EXPECT_EQ(plain.map.lanes[0].right_neighbours[0].lane, message.lanes()[0].right_neighbours()[0].lane());
  EXPECT_EQ(plain.map.linkages[0].from, message.linkages()[0].from_lane());
  EXPECT_EQ(plain.map.T_map_body.translation().x(), message.pose().position().x());

  msg::VehiclePose pose;
  const double half = std::sqrt(0.5);
  to_msg(VehiclePose{.stamp_ns = 5, .position = {1, 2, 3}, .orientation = {half, 0, 0, half}}, "odom", pose);
  EXPECT_EQ(pose.header().frame_id().to_string(), "odom");
  EXPECT_EQ(pose.pose().position().z(), 3.0);
  EXPECT_EQ(pose.pose().orientation().w(), half);
  EXPECT_EQ(pose.pose().orientation().z(), half);
  EXPECT_EQ(pose.pose().orientation().x(), 0.0);
}

TEST(Convert, AWayWithoutStationsIsNone) {
  PublishedMap none, received;
  msg::LaneMap message;
  to_msg(none, "map", message);
  EXPECT_TRUE(message.way().stations().empty());
  ASSERT_EQ(from_msg(message, "map", received), "");
  EXPECT_FALSE(received.map.way);
}

TEST(Convert, AWayThatIsNoLineIsRefused) {
  for (const auto& [stations, step_m] : {std::pair(1, 1.0), std::pair(2, 0.0), std::pair(2, -1.0)}) {
    msg::LaneMap message;
    to_msg(PublishedMap{}, "map", message);
    message.way().stations().resize(static_cast<std::size_t>(stations));
    message.way().step_m(step_m);
    PublishedMap received;
    EXPECT_EQ(from_msg(message, "map", received), "wrong_size") << stations << " " << step_m;
  }
}

TEST(Convert, AMapFarFromItsVehicleIsRefused) {
  for (const double x : {2e5, 1e7, 1e300}) {
    auto message = RandomMessages(1).lane_map();
    message.lanes()[0].left()[0].x(x);
    PublishedMap received;
    EXPECT_EQ(from_msg(message, "map", received), "coordinate") << x;
  }
}

TEST(Convert, AMapWhoseLinesCannotBeWalkedAlongIsRefused) {
  const auto refused = [](const std::function<void(msg::LaneMap&)>& spoil) {
    auto message = RandomMessages(1).lane_map();
    spoil(message);
    PublishedMap received;
    return from_msg(message, "map", received);
  };
  ASSERT_EQ(refused([](msg::LaneMap&) {}), "");
  EXPECT_EQ(refused([](msg::LaneMap& map) { map.lanes()[0].centerline().clear(); }), "coordinate");
  EXPECT_EQ(refused([](msg::LaneMap& map) {
              map.driven_paths().resize(1);
              map.driven_paths()[0].points().clear();
            }),
            "coordinate");
  // 90 km to and fro: each place is near, and the line is as long as the equator.
  std::vector<msg::Point> long_line(900);
  for (std::size_t i = 0; i < long_line.size(); ++i) long_line[i].x(i % 2 == 0 ? 0.0 : 9e4);
  EXPECT_EQ(refused([&](msg::LaneMap& map) { map.lanes()[0].centerline(long_line); }), "coordinate");
  EXPECT_EQ(refused([&](msg::LaneMap& map) {
              map.linkages().resize(1);
              map.linkages()[0].path(long_line);
            }),
            "coordinate");
}

TEST(Convert, EvidenceOfAnUnknownKindIsRefused) {
  auto message = RandomMessages(1).lane_map();
  message.lanes()[0].evidence(32);
  PublishedMap received;
  EXPECT_EQ(from_msg(message, "map", received), "unknown_enum");
}

TEST(Convert, AgesAreTakenFromTheStamp) {
  RoadMarkings markings;
  markings.stamp_ns = 5'000'000'000;
  markings.markings.push_back(Marking{.points = {{0, 0, 0}, {1, 0, 0}}, .first_seen_ns = 2'000'000'001});
  msg::RoadMarkings message;
  to_msg(markings, "map", message);
  EXPECT_DOUBLE_EQ(message.markings()[0].age_s(), 2.999999999);
  EXPECT_EQ(message.markings()[0].unseen_s(), -1.0);
  markings.markings[0].last_seen_ns = 4'500'000'000;
  to_msg(markings, "map", message);
  EXPECT_DOUBLE_EQ(message.markings()[0].unseen_s(), 0.5);
}

TEST(Refuse, AgesThatReachBeyondAllTime) {
  msg::RoadMarkings message;
  to_msg(RoadMarkings{.stamp_ns = std::numeric_limits<std::int64_t>::min() + 10,
                      .markings = {Marking{.id = 1, .points = {{0, 0, 0}, {1, 0, 0}}}}},
         "map", message);
  for (const double age_s : {1.0, std::numeric_limits<double>::quiet_NaN(), 1e300}) {
    message.markings()[0].age_s(age_s);
    RoadMarkings markings;
    EXPECT_EQ(from_msg(message, "map", markings), "not_finite") << age_s;
  }
}

TEST(Refuse, NumbersThatAreNotFinite) {
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity()}) {
    const auto refusal = [](const auto& change) { return refusal_of_detections(2, change); };
    EXPECT_EQ(refusal([&](auto& m) { m.detections()[0].points()[0].y(bad); }), "not_finite");
    EXPECT_EQ(refusal([&](auto& m) { m.detections()[0].confidence(bad); }), "not_finite");
    EXPECT_EQ(refusal([&](auto& m) { m.detections()[0].stddev_m()[0] = bad; }), "not_finite");
    EXPECT_EQ(refusal([&](auto& m) { m.occluded_areas()[0].outline()[0].z(bad); }), "not_finite");
    EXPECT_EQ(refusal([&](auto& m) { m.field_of_view()[0].x(bad); }), "not_finite");
  }
}

TEST(Refuse, UnknownEnumerations) {
  const auto refusal = [](const auto& change) { return refusal_of_detections(3, change); };
  EXPECT_EQ(refusal([](auto& m) { m.detections()[0].type(static_cast<msg::MarkingType>(3)); }),
            "unknown_enum");
  EXPECT_EQ(refusal([](auto& m) { m.detections()[0].style(static_cast<msg::MarkingStyle>(77)); }),
            "unknown_enum");
  EXPECT_EQ(refusal([](auto& m) { m.detected_types()[0] = static_cast<msg::MarkingType>(77); }),
            "unknown_enum");
}

TEST(Refuse, DeviationsThatMatchNoPoints) {
  DetectionFrame frame;
  auto message = RandomMessages(4).detections();
  message.detections()[0].stddev_m().push_back(0.1);
  EXPECT_EQ(from_msg(msg::Detections(message), "map", frame), "wrong_size");
  message.detections()[0].stddev_m().clear();
  EXPECT_EQ(from_msg(msg::Detections(message), "map", frame), "");

  RoadMarkings markings;
  auto marking_message = RandomMessages(4).road_markings();
  marking_message.markings()[0].lateral_stddev_m().push_back(0.1);
  EXPECT_EQ(from_msg(marking_message, "map", markings), "wrong_size");
}

TEST(Refuse, NamesThatAreNotUtf8) {
  DetectionFrame frame;
  auto message = RandomMessages(4).detections();
  message.source("Kamera f\xc3\xbcr vorn");
  EXPECT_EQ(from_msg(msg::Detections(message), "map", frame), "");
  for (const char* bad : {"\xff", "cut \xc3", "long form of / \xc0\xaf", "half a pair \xed\xa0\x80"}) {
    message.source(bad);
    EXPECT_EQ(from_msg(msg::Detections(message), "map", frame), "not_text") << bad;
    message.source("camera");
    message.header().frame_id(bad);
    EXPECT_EQ(from_msg(msg::Detections(message), "map", frame), "not_text") << bad;
    message.header().frame_id("body");
  }
}

TEST(Refuse, DetectionsInTheMapFrame) {
  DetectionFrame frame;
  auto message = RandomMessages(4).detections();
  message.header().frame_id("map");
  EXPECT_EQ(from_msg(msg::Detections(message), "map", frame), "wrong_frame");
  EXPECT_EQ(from_msg(msg::Detections(message), "utm", frame), "");
}

TEST(Convert, ManyDetectedTypesStaySome) {
  DetectionFrame frame;
  frame.detected_types.assign(msg::MAX_TYPES + 1, MarkingType::roadedge);
  frame.detected_types.push_back(MarkingType::laneline);
  msg::Detections message;
  EXPECT_EQ(to_msg(frame, "map", message), 0U);
  const std::vector expected{msg::MarkingType::LANELINE, msg::MarkingType::ROADEDGE};
  EXPECT_EQ(message.detected_types(), expected);
}

TEST(Convert, ASourceWhoseNameIsCutIsCounted) {
  DetectionFrame frame;
  msg::Detections message;
  frame.source = std::string(64, 's');
  EXPECT_EQ(to_msg(frame, "map", message), 0U);
  frame.source += "1";
  EXPECT_EQ(to_msg(frame, "map", message), 1U);
  frame.source = std::string("camera\0left", 11);
  EXPECT_EQ(to_msg(frame, "map", message), 1U) << "a zero ends a name";
}

TEST(Convert, ASourceIsCutBetweenTwoCharacters) {
  for (const std::string last : {"\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x9a\x97"}) {
    DetectionFrame frame, read;
    msg::Detections message;
    for (const std::size_t fits : {64 - last.size(), std::size_t{63}}) {
      frame.source = std::string(fits, 's') + last;
      EXPECT_EQ(to_msg(frame, "map", message), fits == 63 ? 1U : 0U);
      EXPECT_EQ(from_msg(msg::Detections(message), "map", read), "");
      EXPECT_EQ(read.source, fits == 63 ? std::string(63, 's') : frame.source);
    }
  }
}

TEST(Convert, TheStatusOfALongSourceIsText) {
  ServiceStatus status;
  std::string long_name(63, 's');
  long_name += "\xc3\xa9";
  status.sources.push_back({.source = long_name, .learned = {{"beside_" + long_name, 1.0}}});
  msg::ServiceStatus message;
  to_msg(status, "map", message);
  for (const std::string& name :
       {message.sources()[0].source().to_string(), message.sources()[0].learned()[0].name().to_string()})
    EXPECT_TRUE(utf8::is_valid(name.begin(), name.end())) << name;
}

TEST(Refuse, PosesThatAreNone) {
  const auto refusal = refusal_of_a_pose;
  EXPECT_EQ(refusal([](auto& /*good*/) {}), "");
  EXPECT_EQ(refusal([](auto& m) { m.pose().orientation().w(0.9); }), "not_a_rotation");
  EXPECT_EQ(refusal([](auto& m) { m.pose().orientation({}); }), "not_a_rotation");
  EXPECT_EQ(refusal([](auto& m) { m.pose().orientation().x(kNaN); }), "not_finite");
  EXPECT_EQ(refusal([](auto& m) { m.pose().position().x(kNaN); }), "not_finite");
  EXPECT_EQ(refusal([](auto& m) { m.header().frame_id("odom"); }), "wrong_frame");
  EXPECT_EQ(refusal([](auto& m) { m.covariance().pop_back(); }), "wrong_size");
}

TEST(Convert, AnOrientationIsNormalised) {
  auto message = RandomMessages(6).vehicle_pose();
  message.pose().orientation().w(0.5003);
  VehiclePose pose;
  ASSERT_EQ(from_msg(message, message.header().frame_id().to_string(), pose), "");
  EXPECT_NEAR(pose.orientation.norm(), 1.0, 1e-15);
}

}  // namespace
}  // namespace laneloom::dds
