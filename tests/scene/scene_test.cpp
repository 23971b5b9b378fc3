#include <gmock/gmock.h>

#include <algorithm>

#include "drawing/map_elements.hpp"
#include "drawing/small_map.hpp"
#include "laneloom/polyline.hpp"
#include "scene/scene_entities.hpp"
#include "scene/scene_maker.hpp"
#include "scene/triangles.hpp"

namespace laneloom::scene {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The area of all triangles together. Each is counter-clockwise or clockwise.
double area(const Polyline& points, const std::vector<std::uint32_t>& indices) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Point &a = points.at(indices[i]), &b = points.at(indices[i + 1]), &c = points.at(indices[i + 2]);
    sum += 0.5 * std::abs(cross((b - a).head<2>(), (c - a).head<2>()));
  }
  return sum;
}

TEST(Triangles, FillAStripWhateverItsPoints) {
  const Polyline left{{0, 2, 0}, {1, 2, 0}, {7, 2, 0}, {10, 2, 0}}, right{{0, -1, 0}, {10, -1, 0}};
  const auto indices = strip_triangles(left, right);
  EXPECT_EQ(indices.size(), 3 * 4U);
  Polyline points = left;
  points.insert(points.end(), right.begin(), right.end());
  EXPECT_DOUBLE_EQ(area(points, indices), 30.0);
}

TEST(Triangles, FillConvexPolygonsOnly) {
  const Polyline square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_DOUBLE_EQ(area(square, convex_triangles(square)), 4.0);
  EXPECT_THAT(convex_triangles({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}), IsEmpty());
  EXPECT_THAT(convex_triangles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), IsEmpty());
}

foxglove::SceneEntity entity(const std::string& id) {
  foxglove::SceneEntity entity;
  entity.id = id;
  return entity;
}

TEST(SceneStream, DeletesWhatIsNoMoreThereOnce) {
  SceneStream stream;
  EXPECT_THAT(stream.update({entity("a"), entity("b")}, 1).deleted, IsEmpty());
  EXPECT_THAT(stream.update({entity("b"), entity("c")}, 2).deleted, ElementsAre("a"));
  EXPECT_THAT(stream.update({entity("b"), entity("c")}, 3).deleted, IsEmpty());
  EXPECT_THAT(stream.update({}, 4).deleted, ElementsAre("b", "c"));
}

TEST(SceneEntities, DashesAreSegmentsOfTheLine) {
  drawing::Drawing drawing;
  add_boundaries(small_map(), drawing);
  std::vector<foxglove::SceneEntity> entities;
  append_entities(drawing, {"map"}, entities);
  const foxglove::LinePrimitive& dashed = entities.at(0).lines.at(1);
  EXPECT_EQ(dashed.type, foxglove::LineType::list);
  ASSERT_EQ(dashed.points.size() % 2, 0U);
  double painted_m = 0.0;
  for (std::size_t i = 0; i < dashed.points.size(); i += 2)
    painted_m += (dashed.points[i + 1] - dashed.points[i]).norm();
  EXPECT_NEAR(painted_m, 3.6, 1e-9);  // two dashes of 1.8 m, 1.4 m apart, on 6 m
}

TEST(SceneEntities, ALineWithAPointFarAwayIsPaintedSolid) {
  LocalMap map = small_map();
  map.boundaries[0].points.back().x() = 5e6;
  map.boundaries[0].styles = {{{0, 5e6}, MarkingStyle::dashed}};
  drawing::Drawing drawing;
  add_boundaries(map, drawing);
  std::vector<foxglove::SceneEntity> entities;
  append_entities(drawing, {"map"}, entities);
  for (const foxglove::LinePrimitive& line : entities.at(0).lines) {
    EXPECT_EQ(line.type, foxglove::LineType::strip);
    EXPECT_LE(line.points.size(), 3U);
  }
}

TEST(SceneEntities, PointsAreRelativeToAnOriginNearby) {
  LocalMap map = small_map();
  const Point far(600'000.25, 5'700'000.5, 120.0);
  map.T_map_body.translate(far);
  for (Point& point : map.boundaries[0].points) point += far;
  drawing::Drawing drawing;
  drawing.T_map_body = map.T_map_body;
  map.boundaries.resize(1);
  add_boundaries(map, drawing);
  std::vector<foxglove::SceneEntity> entities;
  append_entities(drawing, {"map"}, entities);
  const foxglove::LinePrimitive& line = entities.at(0).lines.at(0);
  EXPECT_LT(line.points.back().norm(), 20.0);
  const Point point = line.origin + line.points.front();
  EXPECT_LT((point - map.boundaries[0].points.front()).head<2>().norm(), 1e-6);
}

TEST(SceneMaker, ObjectsWaitForThePoseAtTheirStampInEitherFrame) {
  const VehiclePose pose{.stamp_ns = 10, .position = Point(100, 0, 0)};
  const TrackedObject car{.id = 7, .kind = ObjectKind::car, .position = {20, 0, 0}, .heading = {1, 0, 0}};
  TrackedObject in_map = car;
  in_map.position.x() = 120.0;
  SceneMaker body("map"), map("map");
  EXPECT_THAT(body.take(TrackedObjects{.stamp_ns = 10, .objects = {car}}, 1), IsEmpty());
  EXPECT_THAT(map.take(TrackedObjects{.stamp_ns = 10, .objects = {in_map}, .in_map_frame = true}, 1),
              IsEmpty());
  const std::vector<SceneMessage> of_body = body.take(pose, 2), of_map = map.take(pose, 2);
  ASSERT_EQ(of_body.size(), 2U) << "its transform, and the objects";
  EXPECT_EQ(of_body[1].topic, SceneTopic::objects);
  EXPECT_EQ(of_body[1].bytes, of_map.at(1).bytes);
}

TEST(SceneMaker, MessagesThatAreNoneChangeNothing) {
  SceneMaker maker("map");
  for (std::size_t topic = 0; topic < std::variant_size_v<recording::AnyMessage>; ++topic) {
    EXPECT_THAT(maker.take({1, topic, {}}), IsEmpty());
    EXPECT_THAT(maker.take({1, topic, std::vector<std::uint8_t>(100, 0xFF)}), IsEmpty());
  }
}

}  // namespace
}  // namespace laneloom::scene
