#include "import/maptr.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "sampled_drive.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::imports {
namespace {

using testing::HasSubstr;

std::string vector(const std::string& class_name, const std::string& points = "[[1,2],[3,4]]",
                   const std::string& confidence = "0.5") {
  return R"({"cls_name":")" + class_name + R"(","confidence_level":)" + confidence +
         R"(,"pts_num":2,"type":0,"pts":)" + points + "}";
}

std::string sample(const std::string& token, const std::string& vectors) {
  return R"({"sample_token":")" + token + R"(","vectors":[)" + vectors + "]}";
}

class MapTr : public testing::Test {
 protected:
  ImportedFrames read(const std::string& samples, const DriveLog& of = drive()) {
    return read_text(R"({"meta":{"use_lidar":false},"results":[)" + samples + "]}", of);
  }
  ImportedFrames read_text(const std::string& text, const DriveLog& of = drive(), bool strict = false) {
    std::ofstream(folder_.file("results.json")) << text;
    left_out_ = LeftOut(strict);
    return read_maptr(folder_.file("results.json"), {of, left_out_, classes_});
  }
  std::string left_out() const { return left_out_.summary(); }
  /// What a strict reader says.
  std::string error(const std::string& text) {
    return thrown_by([&] { read_text(text, drive(), true); });
  }
  void use(Classes classes) { classes_ = std::move(classes); }
  std::string sample_error(const std::string& samples) { return error(R"({"results":[)" + samples + "]}"); }

 private:
  TemporaryFolder folder_;
  LeftOut left_out_;
  Classes classes_ = usual_classes();
};

TEST_F(MapTr, ClassesBecomeTypesAndOthersAreCounted) {
  const ImportedFrames imported =
      read(sample("drive_2", vector("divider") + "," + vector("ped_crossing") + "," + vector("boundary") +
                                 "," + vector("centerline") + "," + vector("centerline")) +
           "," + sample("other_1", vector("divider")) + "," + sample("drive_1", ""));
  ASSERT_EQ(imported.frames.size(), 2u);
  EXPECT_EQ(imported.frames[0].stamp_ns, 1) << "by stamp, not in the order of the file";
  EXPECT_TRUE(imported.frames[0].detections.empty());
  const DetectionFrame& frame = imported.frames[1];
  EXPECT_EQ(frame.stamp_ns, 2);
  EXPECT_EQ(frame.detected_types, (std::vector{MarkingType::laneline, MarkingType::roadedge}));
  ASSERT_EQ(frame.detections.size(), 2u);
  EXPECT_EQ(frame.detections[0].type, MarkingType::laneline);
  EXPECT_EQ(frame.detections[1].type, MarkingType::roadedge);
  EXPECT_EQ(frame.detections[0].confidence, 0.5);
  EXPECT_EQ(imported.left_out, (std::map<std::string, std::size_t>{{"centerline", 2}, {"ped_crossing", 1}}));
  EXPECT_EQ(imported.other_drives, 1u);
}

TEST_F(MapTr, ClassesOfOthersBecomeTheTypesThatAreSaid) {
  use({{"kerb", MarkingType::roadedge}, {"stop", MarkingType::stopline}, {"divider", std::nullopt}});
  const ImportedFrames imported =
      read(sample("drive_2", vector("kerb") + "," + vector("stop") + "," + vector("divider")));
  const DetectionFrame& frame = imported.frames.at(0);
  ASSERT_EQ(frame.detections.size(), 2u);
  EXPECT_EQ(frame.detections[0].type, MarkingType::roadedge);
  EXPECT_EQ(frame.detections[1].type, MarkingType::stopline);
  EXPECT_EQ(frame.detected_types, (std::vector{MarkingType::roadedge, MarkingType::stopline}));
  EXPECT_EQ(imported.left_out.at("divider"), 1u);
}

TEST_F(MapTr, PointsComeToTheBodyFrame) {
  DriveLog lidar = drive();  // x right, y forward, 1 m ahead of the body's origin and 2 m above
  lidar.T_body_points =
      Eigen::Translation3d(1.0, 0.0, 2.0) * Eigen::AngleAxisd(-std::numbers::pi / 2, Point::UnitZ());
  lidar.ground_z_m = -0.3;
  const ImportedFrames imported =
      read(sample("drive_1", vector("divider", "[[4, 10], [4, 20]]") + "," +
                                 vector("divider", "[[4, 10, -1.5], [4, 20, -1.5]]")),
           lidar);
  const auto& detections = imported.frames.at(0).detections;
  EXPECT_TRUE(detections.at(0).points[0].isApprox(Point(11.0, -4.0, -0.3))) << "on the ground";
  EXPECT_TRUE(detections.at(1).points[1].isApprox(Point(21.0, -4.0, 0.5)));
}

TEST_F(MapTr, WhatIsWrongIsNamed) {
  EXPECT_THAT(sample_error(sample("drive_1", vector("divider") + "," + vector("kerb"))),
              HasSubstr("results.json: results[0].vectors[1].cls_name: the class "));
  EXPECT_THAT(sample_error(sample("drive_1", vector("divider", "[[1,2],[3,4]]", "1.01"))),
              HasSubstr("results[0].vectors[0].confidence_level: must be from 0 to 1"));
  EXPECT_THAT(sample_error(sample("drive_1", vector("divider", "[[1,2],[3,\"4\"]]"))),
              HasSubstr("vectors[0].pts[1]: must be a number"));
  EXPECT_THAT(sample_error(sample("drive_1", vector("divider", "[[1,2]]"))), HasSubstr("two points"));
  EXPECT_THAT(sample_error(sample("drive_1", vector("divider", "[[1],[2]]"))), HasSubstr("[x, y]"));
  EXPECT_THAT(sample_error(sample("drive_1", vector("divider", "[[1,2],[1e8,2]]"))), HasSubstr("coordinate"));
  EXPECT_THAT(sample_error(sample("drive_1", "") + "," + sample("drive_1", "")),
              HasSubstr("results[1].sample_token: a second one"));
  EXPECT_THAT(sample_error(sample("other_1", "")), HasSubstr("no sample of drive"));
  EXPECT_THAT(sample_error("1"), HasSubstr("results[0]: must be an object"));
  EXPECT_THAT(error("{}"), HasSubstr("results: is missing"));
  for (const std::string other : {"[]", R"({"type":"FeatureCollection","features":[]})", R"({"results":{}})"})
    EXPECT_THAT(error(other), HasSubstr("results of MapTR have a list `results`")) << other;
  EXPECT_THAT(error(R"({"results":{}})"), HasSubstr("results.json: results: must be an array; "));
  EXPECT_THAT(
      error("{\"t\":1}\n{\"t\":2}\n"),
      testing::EndsWith("results.json: is not JSON: line 2, column 1: syntax error while parsing value - "
                        "unexpected '{'; expected end of input"));
  EXPECT_THAT(error("boundaries"), HasSubstr(": is not JSON: line 1, column 1: "));
  EXPECT_THAT(error(R"({"results":[{"sample_token":"drive_1","vectors")"), HasSubstr("is not JSON"));
  EXPECT_THAT(error(R"({"results":[{"sample_token":)" + std::string(100'000, '[')), HasSubstr("too deeply"));
  EXPECT_THAT(error(""), HasSubstr("is empty"));
  EXPECT_THAT(error("\x80\x04 pickle"), HasSubstr("is a pickle of Python; the results are needed as JSON"));
}

TEST_F(MapTr, WhatIsWrongIsLeftOutAndTheRestComes) {
  const ImportedFrames imported =
      read(sample("drive_1", vector("divider", "[[1,2],[NaN,4]]") + "," + vector("divider") + "," +
                                 vector("divider", "[[1,-Infinity],[3,4]]") + "," + vector("kerb") + "," +
                                 vector("divider", "[[1,2],[3,4]]", "NaN")) +
           R"(,null,{"sample_token":"drive_2"},)" + sample("drive_3", "") + "," + sample("drive_3", "") +
           "," + sample("drive_2", vector("divider")));
  ASSERT_EQ(imported.frames.size(), 3u);
  EXPECT_EQ(imported.frames[0].detections.size(), 1u);
  EXPECT_EQ(imported.frames[1].detections.size(), 1u) << "the first of this stamp that is whole";
  EXPECT_EQ(left_out(),
            "2 x vectors[].pts[]: must be finite (first: results[0].vectors[0]), "
            "1 x vectors[].cls_name: the class kerb is none of boundary, centerline, divider, ped_crossing "
            "(see --class) "
            "(first: results[0].vectors[3]), "
            "1 x vectors[].confidence_level: must be finite (first: results[0].vectors[4]), "
            "1 x must be an object (first: results[1]), "
            "1 x vectors: is missing (first: results[2]), "
            "1 x sample_token: a second one of this stamp (first: results[4])");
  EXPECT_THAT(sample_error(sample("drive_1", vector("divider", "[[1,2],[NaN,4]]"))),
              HasSubstr("results[0].vectors[0].pts[1]: must be finite"));
}

TEST_F(MapTr, AValueThatIsNoNumberLosesItsLineAlone) {
  for (const std::string value : {"NaN", "-NaN", "nan", "-nan", "NAN", "Infinity", "-Infinity", "inf", "-inf",
                                  "-INF", "infinity", "nan.8", "-nan(ind)", "null", R"("NaN")"})
    for (const std::string& line :
         {vector("divider", "[[" + value + ",2],[3,4]]"), vector("divider", "[[1,2],[3," + value + "]]"),
          vector("divider", "[[1,2,0],[3,4," + value + "]]"), vector("divider", "[[1,2],[3,4]]", value)}) {
      const ImportedFrames imported = read(sample("drive_1", line + "," + vector("divider")) + "," +
                                           sample("drive_2", vector("boundary")));
      ASSERT_EQ(imported.frames.size(), 2u) << line;
      EXPECT_EQ(imported.frames[0].detections.size(), 1u) << line;
      EXPECT_EQ(imported.frames[1].detections.size(), 1u) << line;
      EXPECT_THAT(left_out(), HasSubstr("(first: results[0].vectors[0])")) << line;
    }
}

TEST_F(MapTr, NumbersThatAreNotFiniteAreNamedInEverySpelling) {
  for (const std::string value : {"NaN", "-NaN", "nan", "-nan", "NAN", "Infinity", "-Infinity", "inf", "-inf",
                                  "-INF", "infinity", R"("nan")"})
    EXPECT_THAT(sample_error(sample("drive_1", vector("divider", "[[1,2],[3," + value + "]]"))),
                HasSubstr("results[0].vectors[0].pts[1]: must be finite"))
        << value;
}

TEST_F(MapTr, WhereEveryLineIsWrongNothingIsLeft) {
  const auto complaint = [&](const std::string& lines) {
    return thrown_by([&] { read(sample("drive_1", lines) + "," + sample("drive_2", "")); });
  };
  EXPECT_THAT(complaint(vector("kerb")), HasSubstr("results.json: no line is left, as lines are wrong"));
  EXPECT_THAT(complaint(vector("divider", "[[1,2],[NaN,4]]")), HasSubstr("no line is left"));
  EXPECT_THAT(complaint(vector("divider", "[[1,2],[3,4]]", "80")), HasSubstr("no line is left"));
  EXPECT_THAT(left_out(), HasSubstr("1 x vectors[].confidence_level: must be from 0 to 1; percentages have "
                                    "to be divided by 100"));
  EXPECT_EQ(complaint(vector("kerb") + "," + vector("divider")), "");
  EXPECT_EQ(complaint(vector("centerline")), "") << "no line is wanted, and none is wrong";
  EXPECT_EQ(complaint(""), "") << "the network saw nothing";
}

TEST_F(MapTr, AFileThatIsCutOffIsReadUpToThere) {
  const std::string cut = R"({"results":[)" + sample("drive_1", vector("divider")) + "," +
                          sample("drive_2", vector("divider")).substr(0, 50);
  EXPECT_EQ(read_text(cut).frames.size(), 1u);
  EXPECT_EQ(left_out(), "1 x the rest of the file, which is damaged or cut off (first: results[1])");
  EXPECT_THAT(error(cut), HasSubstr("is not JSON"));
}

}  // namespace
}  // namespace laneloom::imports
