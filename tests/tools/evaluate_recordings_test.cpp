#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "io/json_lines.hpp"
#include "recording/recording.hpp"
#include "simulation/road.hpp"

namespace laneloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr std::int64_t kStep_ns = 100'000'000;
const std::string kByTruth = "evaluate --truth truth.json --json score.json ";
const std::string kLater = "evaluate --later --json score.json ";

/// One laneline straight ahead at y = 2, driven along at 10 m/s; recordings of ten moments.
class EvaluateRecordings : public Commands {
 protected:
  void SetUp() override {
    simulation::Road road;
    road.markings = {{1, MarkingType::laneline, MarkingStyle::solid, {{-50, 2, 0}, {100, 2, 0}}}};
    road.drive =
        simulation::Drive::recorded({{.stamp_ns = 0}, {.stamp_ns = kStep_ns, .position = {1, 0, 0}}});
    save_truth(file("truth.json"), road);
  }
  static std::int64_t stamp_ns(int moment) { return 1'000'000'000 + moment * kStep_ns; }

  static VehiclePose pose(std::int64_t stamp) {
    return {.stamp_ns = stamp,
            .sequence = 1,
            .session_id = 1,
            .position = {static_cast<double>(stamp - stamp_ns(0)) * 1e-8, 0, 0}};
  }
  /// Seen where it is, from the vehicle.
  static DetectionFrame frame(std::int64_t stamp) {
    return {.stamp_ns = stamp,
            .session_id = 1,
            .source = "test",
            .detections = {{.confidence = 0.9, .points = {{-5, 2, 0}, {30, 2, 0}}}}};
  }
  /// The laneline as mapped, `off_m` to its left.
  static PublishedMap map(std::int64_t stamp, double off_m) {
    PublishedMap published{.session_id = 1, .frame_id = "map"};
    published.map.stamp_ns = stamp;
    published.map.T_map_body = transform(pose(stamp));
    published.map.boundaries = {{.id = 1, .points = {{-50, 2 + off_m, 0}, {100, 2 + off_m, 0}}}};
    return published;
  }

  json score(const std::string& who) const { return json_of("score.json").at(who); }
};

TEST_F(EvaluateRecordings, FramesAreSeenFromThePoseAtTheirStamp) {
  {
    recording::RecordingWriter out(file("drive.mcap"));
    for (int i = 0; i < 10; ++i) {
      // Between two poses, and before the one behind it has come.
      out.write(pose(stamp_ns(i)), stamp_ns(i));
      out.write(frame(stamp_ns(i) + kStep_ns / 2), stamp_ns(i) + 1);
      out.write(pose(stamp_ns(i)), stamp_ns(i) + 2);  // repeated
    }
    DetectionFrame defective = frame(stamp_ns(8));
    defective.detections[0].points.resize(1);
    out.write(defective, stamp_ns(9) + 3);
    out.close();
  }
  std::filesystem::rename(file("drive.mcap"), file("drive.jsonl"));  // its name is of no account
  ASSERT_TRUE(done(kByTruth + "--frames drive.jsonl"));
  const json raw = score("raw");
  EXPECT_EQ(raw.at("frames"), 9) << "the last one has no pose behind it";
  EXPECT_EQ(raw.at("laneline").at("precision"), 1.0);
  EXPECT_EQ(raw.at("laneline").at("recall"), 1.0);
  EXPECT_LT(raw.at("laneline").at("acd_m"), 0.05);
}

TEST_F(EvaluateRecordings, OfMapsOfOneStampTheLastCountsAndOfNoStampNone) {
  {
    recording::RecordingWriter out(file("maps.mcap"));
    out.write(map(0, 0.0), 1);
    out.write(map(stamp_ns(0), 3.0), 2);
    out.write(map(stamp_ns(0), 0.0), 3);
    out.write(map(stamp_ns(1), 0.0), 4);
    out.write(map(stamp_ns(0), 3.0), 5);  // of before
    PublishedMap degenerate = map(stamp_ns(2), 0.0);
    degenerate.map.boundaries.push_back({.id = 2, .points = {{0, 0, 0}}});
    out.write(degenerate, 6);
    out.close();
  }
  ASSERT_TRUE(done(kByTruth + "--map maps.mcap"));
  const json fused = score("fused");
  EXPECT_EQ(fused.at("frames"), 3);
  EXPECT_EQ(fused.at("laneline").at("precision"), 1.0);
  EXPECT_EQ(fused.at("laneline").at("matched"), 3);
}

TEST_F(EvaluateRecordings, JsonLinesAreReadAsRecordingsAre) {
  io::JsonLinesWriter maps(file("maps.jsonl")), frames(file("frames.jsonl"));
  const auto write = [&](std::int64_t stamp, double off_m) {
    maps.write(map(stamp, off_m).map);
    io::FrameRecord record{frame(stamp), pose(stamp)};
    for (Point& point : record.frame.detections[0].points) point.y() += off_m;
    frames.write(record);
  };
  maps.write(map(0, 3.0).map);  // before the first fused frame
  write(stamp_ns(0), 0.0);
  write(stamp_ns(1), 0.0);
  maps.write(map(stamp_ns(2), 3.0).map);
  write(stamp_ns(2), 0.0);
  write(stamp_ns(1), 3.0);  // of before
  maps.close();
  frames.close();
  ASSERT_TRUE(done(kByTruth + "--map maps.jsonl --frames frames.jsonl"));
  for (const char* who : {"raw", "fused"}) {
    EXPECT_EQ(score(who).at("frames"), 3) << who;
    EXPECT_EQ(score(who).at("laneline").at("matched"), 3) << who;
  }
  EXPECT_THAT(output(), HasSubstr("3 of 4 frames, and 3 of 6 maps compared"));
}

TEST_F(EvaluateRecordings, WhatIsNotComparedIsTold) {
  {
    recording::RecordingWriter out(file("drive.mcap"), {.chunk_bytes = 1});
    VehiclePose defective = pose(stamp_ns(0));
    defective.position.x() = std::numeric_limits<double>::quiet_NaN();
    out.write(defective, stamp_ns(0));
    for (int i = 0; i < 10; ++i) {
      if (i < 5) out.write(pose(stamp_ns(i)), stamp_ns(i));
      out.write(frame(stamp_ns(i)), stamp_ns(i));
    }
    out.close();
  }
  ASSERT_TRUE(done(kByTruth + "--frames drive.mcap"));
  EXPECT_THAT(output(), HasSubstr("5 of 10 frames compared"));
  EXPECT_THAT(output(),
              HasSubstr("drive.mcap: 1 messages passed over: laneloom/v3/vehicle_pose: not_finite"));

  auto bytes = bytes_of(file("drive.mcap"));
  bytes.resize(bytes.size() / 2);
  write_bytes(file("cut.mcap"), bytes);
  run(kByTruth + "--frames cut.mcap");
  EXPECT_THAT(output(), HasSubstr("cut.mcap: left out: 1 x the recording is cut off (first: its end)"));
}

TEST_F(EvaluateRecordings, NothingToCompareIsAFailure) {
  {
    recording::RecordingWriter out(file("drive.mcap"));
    for (int i = 0; i < 3; ++i) out.write(frame(stamp_ns(i)), stamp_ns(i));  // without poses
    out.close();
  }
  std::ofstream(file("empty.jsonl")) << "\n";
  EXPECT_EQ(run(kByTruth + "--frames drive.mcap"), 1);
  EXPECT_THAT(output(), HasSubstr("drive.mcap: of 3 frames"));
  EXPECT_EQ(run(kByTruth + "--map drive.mcap"), 1);
  EXPECT_EQ(run(kByTruth + "--map empty.jsonl"), 1);
  EXPECT_THAT(output(), HasSubstr("none can be compared"));
}

TEST_F(EvaluateRecordings, FiguresOverRangeAndPicturesOfThem) {
  {
    recording::RecordingWriter out(file("maps.mcap"));
    for (int i = 0; i < 3; ++i) out.write(map(stamp_ns(i), 0.2), stamp_ns(i));
    out.close();
  }
  ASSERT_TRUE(done(kByTruth + "--map maps.mcap --plots plots/new"));
  const json fused = score("fused");
  ASSERT_EQ(fused.at("range").at(0).at("from_m"), -5.0);
  for (const json& bin : fused.at("range")) {
    EXPECT_EQ(bin.at("precision"), 1.0);
    EXPECT_EQ(bin.at("recall"), 1.0);
    EXPECT_NEAR(bin.at("lateral_error_m").get<double>(), 0.2, 1e-9);
  }
  const json& errors = fused.at("lateral_error");
  EXPECT_NEAR(errors.at("laneline").at("20-30").at("p90_m").get<double>(), 0.2, 1e-9);
  EXPECT_TRUE(errors.at("stopline").at("0-10").at("p50_m").is_null());
  EXPECT_THAT(output(), HasSubstr("0.200"));
  for (const char* picture : {"over_time.svg", "over_range.svg"})
    EXPECT_THAT(text(std::string("plots/new/") + picture), HasSubstr("</svg>"));
  EXPECT_EQ(text("plots/new/over_time.png").substr(1, 3), "PNG");
  EXPECT_EQ(text("plots/new/over_range.png").substr(1, 3), "PNG");
  EXPECT_EQ(run(kByTruth + "--map maps.mcap --plots maps.mcap"), 1) << "no folder";
}

TEST_F(EvaluateRecordings, ADamagedRecordingIsNamed) {
  {
    recording::RecordingWriter out(file("maps.mcap"));
    for (int i = 0; i < 10; ++i) out.write(map(stamp_ns(i), 0.0), stamp_ns(i));
    out.close();
  }
  auto bytes = bytes_of(file("maps.mcap"));
  bytes.at(bytes.size() / 3) ^= 0xFF;
  write_bytes(file("damaged.mcap"), bytes);
  EXPECT_TRUE(done(kByTruth + "--map damaged.mcap")) << "what is whole is rated";
  EXPECT_THAT(output(), HasSubstr("damaged.mcap: left out: "));
  EXPECT_EQ(run(kByTruth + "--map missing.mcap"), 1);
  EXPECT_THAT(output(), HasSubstr("missing.mcap: cannot be read"));
}

/// Fifty metres along the laneline.
class EvaluateLater : public EvaluateRecordings {
 protected:
  static constexpr int kMoments = 51;

  void record(int moments) const {
    recording::RecordingWriter out(file("drive.mcap"));
    for (int i = 0; i < moments; ++i) {
      out.write(pose(stamp_ns(i)), stamp_ns(i));
      out.write(frame(stamp_ns(i)), stamp_ns(i));
      out.write(map(stamp_ns(i), 0.1), stamp_ns(i));
    }
    out.close();
  }
  json at_20_m() const { return score("laneline").at("20"); }
};

TEST_F(EvaluateLater, MapsADriveAndRatesItByWhatIsSeenLater) {
  record(kMoments);
  ASSERT_TRUE(done(kLater + "--in drive.mcap"));
  EXPECT_THAT(output(), HasSubstr("3 frames rated"));
  EXPECT_EQ(at_20_m().at("seen_later"), 3);
  EXPECT_EQ(at_20_m().at("single").at("recall"), 1.0);
  EXPECT_EQ(at_20_m().at("map").at("recall"), 1.0);
  EXPECT_NEAR(at_20_m().at("map").at("lateral_rms_m"), 0.0, 1e-3);
}

TEST_F(EvaluateLater, RatesTheMapsOfARecording) {
  record(kMoments);
  ASSERT_TRUE(done(kLater + "--frames drive.mcap --map drive.mcap"));
  EXPECT_NEAR(at_20_m().at("map").at("lateral_rms_m"), 0.1, 1e-6);
  EXPECT_THAT(output(), HasSubstr("What the planner takes, from 27 maps"));
  EXPECT_EQ(score("planner").at("own_lane"), 0.0);
}

TEST_F(EvaluateLater, SaysWhenADriveIsTooShort) {
  record(30);
  EXPECT_EQ(run(kLater + "--in drive.mcap"), 1);
  EXPECT_THAT(output(), HasSubstr("drive.mcap: too short to be rated"));
}

TEST_F(EvaluateLater, NeedsADriveOrMaps) {
  record(kMoments);
  EXPECT_EQ(run(kLater + "--frames drive.mcap"), 64);
  EXPECT_THAT(output(), HasSubstr("--later: --in, or --frames and --map"));
  EXPECT_EQ(run(kLater + "--in drive.mcap --truth truth.json"), 64);
}

}  // namespace
}  // namespace laneloom
