#include "import/streammapnet.hpp"

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

constexpr const char* kThree =
    R"("vectors": [[[1, 2], [3, 4]], [[5, 6], [7, 8]], [[0, 1], [0, 2]]], "scores": [0.5, 0.25, 1], "labels": [1, 2, 0])";

class StreamMapNet : public testing::Test {
 protected:
  /// `samples` are the members of results.
  ImportedFrames read(const std::string& samples, const DriveLog& of = drive(-0.3),
                      StreamNetwork network = StreamNetwork::streammapnet, bool strict = false) {
    std::ofstream(folder_.file("submission_vector.json"))
        << R"({"meta": {"output_format": "vector"}, "results": {)" << samples << "}}";
    left_out_ = LeftOut(strict);
    return read_streammapnet(folder_.file("submission_vector.json"), network, {of, left_out_});
  }
  std::string left_out() const { return left_out_.summary(); }
  /// What a strict reader says.
  std::string error(const std::string& samples) {
    return thrown_by([&] { read(samples, drive(-0.3), StreamNetwork::streammapnet, true); });
  }

 private:
  TemporaryFolder folder_;
  LeftOut left_out_;
};

TEST_F(StreamMapNet, LabelsBecomeTypesAndOthersAreCounted) {
  std::string both = R"("drive_2": {)";
  both.append(kThree).append(R"(, "prop": [true, false, false]}, "other_1": {},)");
  both.append(R"("drive_1": {"vectors": [], "scores": [], "labels": [], "props": [],)");
  both.append(R"("track_vectors": [[[1, 2], [3, 4]]], "track_scores": [1], "track_labels": [1]})");
  const ImportedFrames imported = read(both);
  ASSERT_EQ(imported.frames.size(), 2u);
  EXPECT_EQ(imported.frames[0].stamp_ns, 1) << "by stamp, not in the order of the file";
  EXPECT_TRUE(imported.frames[0].detections.empty()) << "tracks are not read";
  const DetectionFrame& frame = imported.frames[1];
  EXPECT_EQ(frame.source, "streammapnet");
  ASSERT_EQ(frame.detections.size(), 2u);
  EXPECT_EQ(frame.detections[0].type, MarkingType::laneline);
  EXPECT_EQ(frame.detections[0].confidence, 0.5);
  EXPECT_TRUE(frame.detections[0].points[1].isApprox(Point(3, 4, -0.3))) << "on the road";
  EXPECT_EQ(frame.detections[1].type, MarkingType::roadedge);
  EXPECT_EQ(imported.left_out, (std::map<std::string, std::size_t>{{"ped_crossing", 1}}));
  EXPECT_EQ(imported.other_drives, 1u);
}

TEST_F(StreamMapNet, OfNuScenesThePointsOfBothNetworksComeToTheBodyFrame) {
  DriveLog scene = drive(-0.3);  // the LiDAR, x right and y forward, is 1 m ahead of the body's origin
  scene.T_body_points =
      Eigen::Translation3d(1.0, 0.0, 2.0) * Eigen::AngleAxisd(-std::numbers::pi / 2, Point::UnitZ());
  scene.points_about_lidar = true;
  scene.ground_z_m = 0.0;
  const std::string sample = R"("drive_1": {"vectors": [[[10, 4], [20, 4]]], "scores": [1], "labels": [1]})";
  const auto first = [&](StreamNetwork network) {
    return read(sample, scene, network).frames.at(0).detections.at(0).points.at(0);
  };
  EXPECT_TRUE(first(StreamNetwork::streammapnet).isApprox(Point(10, 4, 0)))
      << "in the vehicle's frame already";
  EXPECT_TRUE(first(StreamNetwork::maptracker).isApprox(Point(11, 4, 0)))
      << "about the LiDAR, x forward, y left";
}

TEST_F(StreamMapNet, WhatIsWrongIsNamed) {
  const auto sample = [](const std::string& vectors, const std::string& scores, const std::string& labels) {
    return R"("drive_1": {"vectors": )" + vectors + R"(, "scores": )" + scores + R"(, "labels": )" + labels +
           "}";
  };
  EXPECT_THAT(error(sample("[[[1,2],[3,4]]]", "[1]", "[3]")),
              HasSubstr("submission_vector.json: results.drive_1.vectors[0]: the class 3 is none of"));
  EXPECT_THAT(error(sample("[[[1,2],[3,4]]]", "[1.5]", "[1]")), HasSubstr("vectors[0]: must be from 0 to 1"));
  EXPECT_THAT(error(sample("[[[1,2],[3,4]]]", "[1, 1]", "[1]")), HasSubstr("vectors: must be as many as"));
  EXPECT_THAT(error(sample("[[[1,2]]]", "[1]", "[1]")),
              HasSubstr("vectors[0]: must have at least two points"));
  EXPECT_THAT(error(sample("[[[1,2],[1e8,4]]]", "[1]", "[1]")), HasSubstr("coordinate"));
  EXPECT_THAT(error(R"("drive_1": {"vectors": []})"), HasSubstr("results.drive_1.scores: is missing"));
  EXPECT_THAT(error(R"("drive_1": [])"), HasSubstr("results.drive_1: must be an object"));
  EXPECT_THAT(
      error(sample("[]", "[]", "[]") + R"(, "drive_01": {"vectors": [], "scores": [], "labels": []})"),
      HasSubstr("results.drive_01: a second one of this stamp"));
  EXPECT_THAT(error(R"("other": {})"), HasSubstr("no sample of drive"));
  EXPECT_THAT(error(R"("drive_1": nul)"), HasSubstr("is not JSON"));
}

TEST_F(StreamMapNet, WhatIsWrongIsLeftOutAndTheRestComes) {
  const ImportedFrames imported = read(
      R"("drive_1": {"vectors": [[[1, NaN], [3, 4]], [[5, 6], [7, 8]], [[0, 1], [0, 2]]], "scores": [0.5, NaN, 1],)"
      R"("labels": [1, 2, 1]}, "drive_2": {"vectors": []}, "drive_3": nul)");
  ASSERT_EQ(imported.frames.size(), 1u);
  EXPECT_EQ(imported.frames[0].detections.size(), 1u);
  EXPECT_EQ(left_out(),
            "1 x vectors[][]: must be finite (first: results.drive_1.vectors[0]), "
            "1 x vectors[]: must be finite (first: results.drive_1.vectors[1]), "
            "1 x scores: is missing (first: results.drive_2), "
            "1 x the rest of the file, which is damaged or cut off (first: results.drive_3)");
}

}  // namespace
}  // namespace laneloom::imports
