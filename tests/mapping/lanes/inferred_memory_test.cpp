#include "mapping/lanes/inferred_memory.hpp"

#include <gmock/gmock.h>

#include "mapping/lanes/find_lanes.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::boundary;
using test::straight;

boundaries::LaneBoundary road_edge(ElementId id, double y, double from_x = 0.0, double to_x = 60.0) {
  return boundary(id, straight({from_x, y, 0}, {to_x, y, 0}), MarkingType::roadedge);
}

/// A road that is mapped frame by frame.
class InferredMemories : public ::testing::Test {
 protected:
  /// Boundaries that run forward.
  void map(std::vector<boundaries::LaneBoundary> boundaries) {
    ++frame_;
    memory_.recognise(std::vector<Marking>{}, test::scene(frame_), ids_);  // no edge is continued
    boundaries::SectionGraph graph = road_sections(std::move(boundaries), test::at(0), {});
    FoundLanes found = find_lanes(std::move(graph), test::scene(frame_).box, {}, {}, config_);
    boundaries_ = memory_.recognise(std::move(found), test::scene(frame_), config_, ids_).boundaries;
  }

  /// The only divider, which has to be there.
  const Marking& divider() const {
    const auto found = std::ranges::find(boundaries_, ElementStatus::inferred,
                                         [](const boundaries::LaneBoundary& b) { return b.marking.status; });
    if (found == boundaries_.end()) throw std::logic_error("no divider");
    return found->marking;
  }

  LaneConfig config_;
  std::uint64_t frame_ = 0;
  markings::IdSource ids_{100};
  InferredMemory memory_;
  boundaries::Boundaries boundaries_;
};

TEST_F(InferredMemories, KeepTheirIdAsTheWindowMoves) {
  map({road_edge(1, 7), road_edge(2, 0)});
  const ElementId id = divider().id;
  map({road_edge(1, 7.2, 10, 70), road_edge(2, 0.2, 10, 70)});
  EXPECT_EQ(divider().id, id);
  EXPECT_EQ(divider().first_seen_ns, 1);
  map({road_edge(1, 7, 200, 260), road_edge(2, 0, 200, 260)});
  EXPECT_NE(divider().id, id);
}

TEST_F(InferredMemories, OnTheBridgeIsAnotherThanBelow) {
  map({road_edge(1, 7), road_edge(2, 0)});
  const ElementId id = divider().id;
  std::vector<boundaries::LaneBoundary> above{road_edge(1, 7), road_edge(2, 0)};
  for (boundaries::LaneBoundary& boundary : above)
    for (Point& point : boundary.marking.points) point.z() = 6.0;
  map(above);
  EXPECT_NE(divider().id, id);
}

TEST_F(InferredMemories, KeepTheirIdsFromFrameToFrameHoweverShortTheMemory) {
  config_.id_memory_frames = 0;
  map({road_edge(1, 7), road_edge(2, 0)});
  const ElementId id = divider().id;
  map({road_edge(1, 7), road_edge(2, 0)});
  EXPECT_EQ(divider().id, id);
}

TEST_F(InferredMemories, AreForgottenAfterAWhile) {
  map({road_edge(1, 7), road_edge(2, 0)});
  const ElementId id = divider().id;
  for (int i = 0; i <= config_.id_memory_frames; ++i) map({});
  map({road_edge(1, 7), road_edge(2, 0)});
  EXPECT_NE(divider().id, id);
}

TEST_F(InferredMemories, AreAmongTheBoundariesByTheirId) {
  map({road_edge(1, 7), road_edge(2, 0)});
  map({road_edge(1, 7), road_edge(200, 0)});
  std::vector<ElementId> ids;
  for (const boundaries::LaneBoundary& boundary : boundaries_) ids.push_back(boundary.marking.id);
  EXPECT_THAT(ids, testing::ElementsAre(1U, 100U, 200U));
  for (const boundaries::LaneBoundary& boundary : boundaries_)
    EXPECT_EQ(boundary.course.points().front(), boundary.marking.points.front());
}

}  // namespace
}  // namespace laneloom::lanes
