#include "io/json_lines.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::io {
namespace {

namespace fs = std::filesystem;

FrameRecord full_frame() {
  FrameRecord record;
  record.frame.stamp_ns = 1'700'000'000'123'456'789;
  record.frame.sequence = 7;
  record.frame.session_id = UINT64_MAX;
  record.frame.source = "front";
  record.frame.detected_types = {MarkingType::laneline, MarkingType::stopline};
  record.frame.field_of_view = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  record.frame.occluded_areas = {{{5.0, 0.0, 0.0}, {6.0, 0.0, 0.0}, {6.0, 1.0, 0.0}}};
  record.frame.detections = {{.type = MarkingType::roadedge,
                              .style = MarkingStyle::dashed,
                              .confidence = 0.1,
                              .points = {{1.0, 0.1, -0.3}, {2.0, 1e-17, -1e7}},
                              .stddev_m = {0.1, 0.2}}};
  record.pose.stamp_ns = record.frame.stamp_ns;
  record.pose.position = {1.5, -2.5, 3.0};
  record.pose.orientation = Eigen::AngleAxisd(0.3, Point::UnitZ());
  return record;
}

TEST(FrameJson, IsReadAsItWasWritten) {
  const FrameRecord record = full_frame(), read = frame_from_json(to_json_line(record));
  EXPECT_EQ(read.frame.stamp_ns, record.frame.stamp_ns) << "exact, though t is rounded";
  EXPECT_EQ(read.frame.sequence, 7u);
  EXPECT_EQ(read.frame.session_id, UINT64_MAX);
  EXPECT_EQ(read.frame.source, "front");
  EXPECT_EQ(read.frame.detected_types, record.frame.detected_types);
  EXPECT_EQ(read.frame.field_of_view, record.frame.field_of_view);
  EXPECT_EQ(read.frame.occluded_areas, record.frame.occluded_areas);
  ASSERT_EQ(read.frame.detections.size(), 1u);
  EXPECT_EQ(read.frame.detections[0].type, MarkingType::roadedge);
  EXPECT_EQ(read.frame.detections[0].style, MarkingStyle::dashed);
  EXPECT_EQ(read.frame.detections[0].confidence, 0.1);
  EXPECT_EQ(read.frame.detections[0].points, record.frame.detections[0].points);
  EXPECT_EQ(read.frame.detections[0].stddev_m, record.frame.detections[0].stddev_m);
  EXPECT_EQ(read.pose.stamp_ns, record.frame.stamp_ns);
  EXPECT_EQ(read.pose.position, record.pose.position);
  EXPECT_LT(read.pose.orientation.angularDistance(record.pose.orientation), 1e-9);
}

TEST(FrameJson, ObjectsAreReadAsTheyWereWritten) {
  FrameRecord record = full_frame();
  record.objects = TrackedObjects{.objects = {{.id = UINT64_MAX,
                                               .kind = ObjectKind::trailer,
                                               .existence_probability = 0.75,
                                               .position = {10.0, -2.5, 0.1},
                                               .heading = {0.6, 0.8, 0.0},
                                               .speed_mps = -3.5,
                                               .position_stddev_m = 0.3,
                                               .length_m = 12.0,
                                               .width_m = 2.5},
                                              {.id = 2}}};
  const FrameRecord read = frame_from_json(to_json_line(record));
  ASSERT_TRUE(read.objects);
  EXPECT_EQ(read.objects->stamp_ns, record.frame.stamp_ns);
  EXPECT_EQ(read.objects->sequence, 7U);
  EXPECT_EQ(read.objects->session_id, UINT64_MAX);
  ASSERT_EQ(read.objects->objects.size(), 2U);
  const TrackedObject &was = record.objects->objects[0], &is = read.objects->objects[0];
  EXPECT_EQ(is.id, was.id);
  EXPECT_EQ(is.kind, was.kind);
  EXPECT_EQ(is.existence_probability, was.existence_probability);
  EXPECT_EQ(is.position, was.position);
  EXPECT_EQ(is.heading, was.heading);
  EXPECT_EQ(is.speed_mps, was.speed_mps);
  EXPECT_EQ(is.position_stddev_m, was.position_stddev_m);
  EXPECT_EQ(is.length_m, was.length_m);
  EXPECT_EQ(is.width_m, was.width_m);
  EXPECT_EQ(read.objects->objects[1].existence_probability, -1.0);

  record.objects->objects.clear();
  EXPECT_TRUE(frame_from_json(to_json_line(record)).objects) << "a tracker that follows none";
  record.objects.reset();
  EXPECT_FALSE(frame_from_json(to_json_line(record)).objects) << "there is no tracker";
}

TEST(FrameJson, ATurnIsReadAsItWasWritten) {
  FrameRecord record = full_frame();
  record.next_turn = NextTurn{.turn = Linkage::Turn::right, .distance_m = 62.5};
  const FrameRecord read = frame_from_json(to_json_line(record));
  ASSERT_TRUE(read.next_turn);
  EXPECT_EQ(read.next_turn->stamp_ns, record.frame.stamp_ns);
  EXPECT_EQ(read.next_turn->session_id, UINT64_MAX);
  EXPECT_EQ(read.next_turn->turn, Linkage::Turn::right);
  EXPECT_EQ(read.next_turn->distance_m, 62.5);
  record.next_turn.reset();
  EXPECT_FALSE(frame_from_json(to_json_line(record)).next_turn);
  const std::string begin = R"({"t":1.5,"pose":[0,0,0,0,0,0,1],"detections":[],"next_turn":)";
  for (const char* turn : {R"({"turn":"left"})", R"({"distance":3})", R"({"turn":"back","distance":3})", "3"})
    EXPECT_THROW(frame_from_json(begin + turn + "}"), std::runtime_error) << turn;
}

TEST(FrameJson, OfAnObjectOnlyIdAndPositionMustBeThere) {
  const auto line = [](const std::string& object) {
    return R"({"t":1.5,"pose":[0,0,0,0,0,0,1],"detections":[],"objects":[)" + object + "]}";
  };
  EXPECT_EQ(frame_from_json(line(R"({"id":3,"position":[1,2,3]})")).objects->objects[0].id, 3U);
  for (const char* object :
       {R"({"id":3})", R"({"position":[1,2,3]})", R"({"id":3,"position":[1,2]})",
        R"({"id":3,"position":[1,2,3],"kind":4})", R"({"id":3,"position":[1,2,3],"existence":2})"})
    EXPECT_THROW(frame_from_json(line(object)), std::runtime_error) << object;
}

TEST(FrameJson, ObjectsOfOtherKindsAreUnknown) {
  const FrameRecord read = frame_from_json(
      R"({"t":1.5,"pose":[0,0,0,0,0,0,1],"detections":[],"objects":[{"id":3,"kind":"van","position":[1,2,3]},)"
      R"({"id":4,"kind":"truck","position":[1,2,3]}]})");
  ASSERT_EQ(read.objects->objects.size(), 2U);
  EXPECT_EQ(read.objects->objects[0].kind, ObjectKind::unknown);
  EXPECT_EQ(read.objects->objects[1].kind, ObjectKind::truck);
}

TEST(FrameJson, AnObjectThatCannotBeReadIsLeftOutAlone) {
  LeftOut left_out;
  const FrameRecord read = frame_from_json(
      R"({"t":1.5,"pose":[0,0,0,0,0,0,1],"detections":[{"type":"laneline","score":0.5,"points":[[0,0,0],[1,0,0]]}],)"
      R"("objects":[{"id":"8d3f","position":[1,2,3]},{"id":4,"position":[1,2,3]}]})",
      {.left_out = left_out, .place = "line 1"});
  EXPECT_EQ(read.frame.detections.size(), 1U);
  ASSERT_EQ(read.objects->objects.size(), 1U);
  EXPECT_EQ(read.objects->objects[0].id, 4U);
  EXPECT_EQ(left_out.summary(),
            "1 x objects[].id: must be an integer that is not negative (first: line 1.objects[0])");
}

TEST(FrameJson, ClassesOfOthersBecomeTheTypesThatAreSaid) {
  const auto line = [](const std::string& type) {
    return R"({"type":")" + type + R"(","score":0.5,"points":[[0,0,0],[1,0,0]]})";
  };
  const auto read = [](const std::string& lines, LeftOut& left_out) {
    const std::string frame =
        R"({"t":1.5,"pose":[0,0,0,0,0,0,1],"detected_types":["kerb","arrow"],"detections":[)" + lines + "]}";
    return frame_from_json(frame, {.left_out = left_out,
                                   .conventions = {.classes = {{"kerb", MarkingType::roadedge},
                                                               {"roadedge", MarkingType::laneline},
                                                               {"arrow", std::nullopt}}}})
        .frame;
  };
  LeftOut left_out;
  const DetectionFrame frame = read(
      line("arrow") + "," + line("kerb") + "," + line("roadedge") + "," + line("stopline") + "," + line("x"),
      left_out);
  std::vector<MarkingType> types;
  for (const Detection& detection : frame.detections) types.push_back(detection.type);
  EXPECT_EQ(types, (std::vector{MarkingType::roadedge, MarkingType::laneline, MarkingType::stopline}))
      << "no class is taken twice";
  EXPECT_EQ(frame.detected_types, std::vector{MarkingType::roadedge});
  EXPECT_EQ(left_out.summary(),
            "1 x detections[].type: must be one of laneline, roadedge, stopline (first: .detections[4])");
  EXPECT_TRUE(read(line("arrow"), left_out).detections.empty()) << "such a frame saw nothing";
}

TEST(FrameJson, TheOptionalKeysMayBeAbsent) {
  const FrameRecord read = frame_from_json(
      R"({"t":1.5,"pose":[0,0,0,0,0,0,1],"detections":[{"type":"laneline","score":0.5,"points":[[0,0,0],[1,0,0]]}]})");
  EXPECT_EQ(read.frame.stamp_ns, 1'500'000'000);
  EXPECT_TRUE(read.frame.detected_types.empty());
  EXPECT_EQ(read.frame.detections[0].style, MarkingStyle::unknown);
}

std::string complaint(const std::string& line) {
  return thrown_by([&] { frame_from_json(line); });
}

std::string frame_with(const std::string& detections, const std::string& pose = "[0,0,0,0,0,0,1]",
                       const std::string& t = "1") {
  return R"({"t":)" + t + R"(,"pose":)" + pose + R"(,"detections":)" + detections + "}";
}

TEST(FrameJson, WhatIsWrongIsNamed) {
  EXPECT_EQ(complaint(frame_with("[]")), "");
  EXPECT_EQ(complaint(frame_with("{}")), "detections: must be an array");
  EXPECT_EQ(complaint(frame_with("[3]")), "detections[0]: must be an object");
  EXPECT_EQ(complaint(frame_with(R"([{"type":"laneline","score":2,"points":[[0,0,0],[1,0,0]]}])")),
            "detections[0].score: must be from 0 to 1");
  EXPECT_EQ(complaint(frame_with(R"([{"type":"laneline","score":0.5,"points":[[0,0,0],[1,0]]}])")),
            "detections[0].points[1]: must be [x, y, z]");
  EXPECT_EQ(complaint(frame_with(R"([{"type":"laneline","score":0.5,"points":[[0,0,0]]}])")),
            "detections[0].points: must have at least two points");
  EXPECT_EQ(complaint(frame_with(R"([{"type":"lane","score":0.5,"points":[]}])")),
            "detections[0].type: must be one of laneline, roadedge, stopline");
  EXPECT_EQ(complaint(frame_with("[]", "[0,0,0,0,0,0,2]")), "pose: must have a quaternion of unit length");
  EXPECT_EQ(complaint(frame_with("[]", "[0,0,0]")), "pose: must be [x, y, z, qx, qy, qz, qw]");
  for (const std::string t : {"1e300", "4.6e9"})  // nor would a service believe such a stamp
    EXPECT_EQ(complaint(frame_with("[]", "[0,0,0,0,0,0,1]", t)), "t: is too large");
  EXPECT_EQ(complaint(R"({"stamp_ns":4611686018427387904,)" + frame_with("[]").substr(1)),
            "stamp_ns: is too large");
  EXPECT_EQ(complaint(frame_with("[]", "[0,0,0,0,0,0,1]", "-0.1")), "t: must be 0 or above");
  EXPECT_EQ(complaint(frame_with("[]", "[0,-1.1e7,0,0,0,0,1]")), "pose: is too far away");
  EXPECT_EQ(complaint(frame_with(R"([{"type":"laneline","score":0.5,"points":[[0,0,0],[1e308,0,0]]}])")),
            "detections[0].points[1]: is too far away");
  EXPECT_EQ(complaint(R"({"t":1,"detections":[]})"), "pose: is missing");
  EXPECT_EQ(complaint("[]"), "must be an object");
}

TEST(FrameJson, HostileTextIsRefused) {
  for (const std::string& line :
       {frame_with("[]", "[NaN,0,0,0,0,0,1]"), frame_with("[]", "[1e999,0,0,0,0,0,1]"),
        std::string("{\"t\":1"), std::string(1'000'000, '['), std::string(100'000, '{'),
        std::string("\xff\xfe"), std::string("null"), frame_with("[]", "[0,0,0,0,0,0,1]", "1") + "x",
        R"({"sequence":-1,)" + frame_with("[]").substr(1),
        R"({"stamp_ns":18446744073709551615,)" + frame_with("[]").substr(1)})
    EXPECT_NE(complaint(line), "") << line.substr(0, 60);
}

TEST(JsonLines, ErrorsNameFileAndLineAndReadingGoesOn) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("frames.jsonl");
  {
    JsonLinesWriter writer(path);
    writer.write(full_frame());
    writer.close();
    std::ofstream(path, std::ios::app) << "\n{\"t\":1}\n" << to_json_line(full_frame());
  }
  JsonLinesReader reader(path);
  EXPECT_TRUE(reader.next_frame());
  EXPECT_EQ(thrown_by([&] { reader.next_frame(); }), path.string() + ":3: pose: is missing");
  EXPECT_TRUE(reader.next_frame()) << "a last line without an end";
  EXPECT_FALSE(reader.next_frame());
}

TEST(JsonLines, LinesOfAnyLengthAreReadWhole) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("lines.jsonl");
  LeftOut left_out;
  for (const std::size_t length : {40U, 16382U, 16383U, 16384U, 32766U, 32767U, 100'000U}) {
    std::string line = R"({"t":1,"x":")";
    line += std::string(length - line.size() - 2, 'x') + R"("})";
    std::ofstream(path) << line << "\n" << line << "\r\n\n" << line;
    JsonLinesReader reader(path);
    EXPECT_EQ(reader.next_stamped(left_out)->text, line) << length;
    EXPECT_EQ(reader.next_stamped(left_out)->text, line + "\r") << length;
    EXPECT_EQ(reader.next_stamped(left_out)->text, line) << length;
    EXPECT_FALSE(reader.next_stamped(left_out)) << length;
  }
  EXPECT_EQ(left_out.summary(), "");
}

TEST(JsonLines, ALineOfMoreThan64MiBIsRefusedAndReadingGoesOn) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("lines.jsonl");
  const std::string longest(std::size_t{64} << 20, 'x');
  std::ofstream(path) << longest << "\n" << longest << "x\n" << to_json_line(full_frame());
  JsonLinesReader reader(path);
  EXPECT_NE(thrown_by([&] { reader.next_frame(); }), path.string() + ":1: the line is too long");
  EXPECT_EQ(thrown_by([&] { reader.next_frame(); }), path.string() + ":2: the line is too long");
  EXPECT_TRUE(reader.next_frame());
}

TEST(JsonLines, ADetectionThatIsWrongDoesNotLoseItsFrame) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("frames.jsonl");
  const std::string good = R"({"type":"laneline","score":0.5,"points":[[0,0,0],[1,0,0]]})";
  const std::string bad = R"({"type":"laneline","score":80,"points":[[0,0,0],[1,0,0]]})";
  std::ofstream(path) << frame_with("[" + bad + "," + good + "]") << "\n"
                      << frame_with("[" + bad + "]") << "\n";
  LeftOut left_out;
  JsonLinesReader reader(path);
  EXPECT_EQ(reader.next_frame(left_out)->frame.detections.size(), 1u);
  EXPECT_FALSE(reader.next_frame(left_out)) << "an empty frame would say that nothing was seen";
  EXPECT_EQ(left_out.summary(),
            "2 x detections[].score: must be from 0 to 1 (first: line 1.detections[0]), "
            "1 x detections: none of them can be read (first: line 2)");

  LeftOut strict(/*strict=*/true);
  EXPECT_THROW(JsonLinesReader(path).next_frame(strict), std::runtime_error);
  JsonLinesReader any(path, FrameConventions{.any_confidence = true});
  EXPECT_EQ(any.next_frame(strict)->frame.detections[0].confidence, 80.0);
}

TEST(JsonLines, FilesThatCannotBeOpenedAreErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(JsonLinesReader(folder.file("absent.jsonl")), std::runtime_error);
  EXPECT_THROW(JsonLinesReader{folder.path()}, std::runtime_error);
  EXPECT_THROW(JsonLinesWriter(folder.file("absent/x.jsonl")), std::runtime_error);
}

}  // namespace
}  // namespace laneloom::io
