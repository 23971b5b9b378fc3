#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "drawing/frame_elements.hpp"
#include "drawing/map_elements.hpp"
#include "drawing/traffic_elements.hpp"
#include "io/json_lines.hpp"
#include "laneloom/element_names.hpp"
#include "recording/recording.hpp"
#include "scene/scene_recording.hpp"

// A drive through the town as a recording with scenes, and what npm's readers find in it.
namespace laneloom::scene {
namespace {

using nlohmann::json;

json to_json(const Polyline& points) {
  json out = json::array();
  for (const Point& point : points) out.push_back({point.x(), point.y(), point.z()});
  return out;
}

json form_json(const drawing::DrawnLine& line) {
  return {{"form", "line"}, {"points", to_json(line.points)}};
}
json form_json(const drawing::DrawnArea& area) {
  Polyline points = area.left;
  points.insert(points.end(), area.right.begin(), area.right.end());
  return {{"form", "area"}, {"points", to_json(points)}};
}
json form_json(const drawing::DrawnArrow& arrow) {
  return {{"form", "arrow"}, {"points", to_json({arrow.tip})}};
}
json form_json(const drawing::DrawnText& text) {
  return {{"form", "text"}, {"points", to_json({text.position})}, {"text", text.text}};
}

json entities_json(const drawing::Drawing& drawing, const std::string& frame) {
  json out = json::array();
  for (const drawing::Element& element : drawing.elements()) {
    json entity{{"id", element.key}, {"frame_id", frame}, {"type", element.type}, {"shapes", json::array()}};
    if (element.status) entity["status"] = name(*element.status);
    for (const drawing::Shape& shape : element.shapes) {
      json form = std::visit([](const auto& any) { return form_json(any); }, shape.form);
      const drawing::Colour colour = drawing::palette::of(shape.style).dark;
      form["colour"] = {colour.red, colour.green, colour.blue, colour.alpha * shape.opacity};
      form["dashed"] = drawing::palette::of(shape.style).dash_on > 0.0;
      entity["shapes"].push_back(std::move(form));
    }
    out.push_back(std::move(entity));
  }
  return out;
}

class SceneRecording : public Commands {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(std::string(INDEPENDENT_FOLDER) + "/node_modules/@mcap/core"))
      GTEST_SKIP() << "the npm registry could not be reached (see the test independent_install)";
    ASSERT_TRUE(
        done("simulate --scenario town --traffic usual --noise inhouse --duration 12 --frames "
             "drive.frames.jsonl"));
    ASSERT_TRUE(done("replay drive.frames.jsonl --out maps.mcap"));
    write_drive();
    ASSERT_TRUE(done("import scene --in drive.mcap --out scene.mcap"));
  }

  int compare() { return shell("node '" INDEPENDENT_FOLDER "/scene.mjs' scene.mcap expected.jsonl"); }

  /// Frames, poses and maps as one recording, and what has to be drawn of it.
  void write_drive() {
    std::map<std::int64_t, PublishedMap> maps;
    recording::RecordingReader reader(file("maps.mcap"));
    while (const auto message = reader.next())
      if (const auto* map = std::get_if<PublishedMap>(&message->message)) maps[map->map.stamp_ns] = *map;
    recording::RecordingWriter out(file("drive.mcap"));
    std::ofstream expected(file("expected.jsonl"));
    io::JsonLinesReader frames(file("drive.frames.jsonl"));
    while (const auto record = frames.next_frame()) {
      const std::int64_t time_ns = record->frame.stamp_ns;
      out.write(record->frame, time_ns);
      out.write(*record->objects, time_ns);
      out.write(record->pose, time_ns + 1);
      expect(*record, time_ns + 1, expected);
      if (const auto map = maps.find(time_ns); map != maps.end()) {
        out.write(map->second, time_ns + 2);
        expect(map->second, time_ns + 2, expected);
      }
    }
    out.close();
  }

  static void expect(const io::FrameRecord& record, std::int64_t time_ns, std::ostream& to) {
    const Eigen::Isometry3d T_map_body = transform(record.pose);
    const Eigen::Quaterniond& q = record.pose.orientation;
    to << json{{"topic", "/tf"},
               {"log_time", std::to_string(time_ns)},
               {"translation", to_json({record.pose.position})[0]},
               {"rotation", {q.x(), q.y(), q.z(), q.w()}}}
       << '\n';
    drawing::Drawing detections, objects;
    add_detections(record.frame, T_map_body, detections);
    add_view(record.frame, T_map_body, detections);
    add_objects(*record.objects, T_map_body, objects);
    to << json{{"topic", "/laneloom/scene/detections"},
               {"log_time", std::to_string(time_ns)},
               {"entities", entities_json(detections, "map")}}
       << '\n'
       << json{{"topic", "/laneloom/scene/objects"},
               {"log_time", std::to_string(time_ns)},
               {"entities", entities_json(objects, "map")}}
       << '\n';
  }
  static void expect(const PublishedMap& published, std::int64_t time_ns, std::ostream& to) {
    drawing::Drawing drawing, vehicle, ids;
    add_map(published.map, drawing);
    add_uncertainty(published.map, drawing);
    add_vehicle(Eigen::Isometry3d::Identity(), vehicle);
    add_ids(published.map, ids);
    json entities = entities_json(drawing, published.frame_id);
    for (json& part : entities_json(vehicle, "body")) entities.push_back(part);
    to << json{{"topic", "/laneloom/scene"},
               {"log_time", std::to_string(time_ns)},
               {"entities", std::move(entities)}}
       << '\n'
       << json{{"topic", "/laneloom/scene/ids"},
               {"log_time", std::to_string(time_ns)},
               {"entities", entities_json(ids, published.frame_id)}}
       << '\n';
  }
};

TEST_F(SceneRecording, IndependentReadersFindTheDrawingList) {
  EXPECT_EQ(compare(), 0) << output();
  EXPECT_THAT(output(), testing::HasSubstr("600 messages"));
}

// The comparison itself: one coordinate that differs is found.
TEST_F(SceneRecording, IndependentReadersFindAPointThatDiffers) {
  std::string expected = text("expected.jsonl");
  const auto at = expected.rfind(R"("form":"area","points":[[)");
  ASSERT_NE(at, std::string::npos);
  expected.insert(expected.find("[[", at) + 2, expected[expected.find("[[", at) + 2] == '-' ? "-9" : "9");
  if (const auto twice = expected.find("-9-", at); twice != std::string::npos) expected.erase(twice + 2, 1);
  std::ofstream(file("expected.jsonl")) << expected;
  EXPECT_NE(compare(), 0);
  EXPECT_THAT(output(), testing::HasSubstr("AssertionError"));
}

TEST_F(SceneRecording, TheRestIsTheSameByteForByte) {
  recording::RecordingReader before(file("drive.mcap")), after(file("scene.mcap"));
  std::size_t count = 0;
  while (const auto wanted = before.next_raw()) {
    const auto found = after.next_raw();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->topic, wanted->topic);
    EXPECT_EQ(found->log_time_ns, wanted->log_time_ns);
    EXPECT_EQ(found->bytes, wanted->bytes);
    ++count;
  }
  EXPECT_EQ(count, 480U);
  EXPECT_FALSE(after.next_raw());
  EXPECT_TRUE(after.refused().values().empty());
}

TEST_F(SceneRecording, TheConfigurationIsKept) {
  ASSERT_TRUE(done("import scene --in maps.mcap --out maps_scene.mcap"));
  ASSERT_TRUE(done("info --configuration maps.mcap"));
  const std::string configuration = output();
  ASSERT_TRUE(done("info --configuration maps_scene.mcap"));
  EXPECT_EQ(output(), configuration);
}

TEST_F(SceneRecording, TheLayoutShowsTopicsThatThereAre) {
  std::ifstream in(std::string(LANELOOM_SOURCE) + "/config/foxglove/layout.json");
  const json panel = json::parse(in)["configById"]["3D!laneloom"];
  std::size_t shown = 0;
  for (const auto& [topic, settings] : panel["topics"].items()) {
    EXPECT_THAT(scene_topics(), testing::Contains(testing::Field(&recording::ExtraTopic::name, topic)));
    shown += settings["visible"] == true ? 1U : 0U;
  }
  EXPECT_EQ(shown, 3U);
  EXPECT_EQ(panel["followTf"], "body");
}

}  // namespace
}  // namespace laneloom::scene
