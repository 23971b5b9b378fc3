#include "export/weld.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "export/gates.hpp"
#include "export/network_builder.hpp"
#include "export/node_groups.hpp"
#include "export/single_borders.hpp"
#include "export/strays.hpp"

namespace laneloom::exports {
namespace {

constexpr double kWeld_m = 2.0;          // ends of borders that are nearer are moved together
constexpr double kMinConnector_m = 2.0;  // a shorter linkage gets no lanelet
constexpr double kEntry_m = 8.0;  // a lane that begins beside the end of another is entered this far on

/// The treatment of a linkage.
struct Joint {
  std::size_t from = 0, to = 0;  ///< indices of lanes
  bool welded = false;
  Gates::Gate exit, entry;  ///< where its lanelet leaves the one and enters the other
};

/// Joins lanes that meet, and finds the gates where other lanes are left and entered.
class Joiner {
 public:
  Joiner(const LocalMap& map, Gates& gates, NodeGroups& groups) : map_(map), gates_(gates), groups_(groups) {
    for (const Lane& lane : map.lanes) index_.emplace(lane.id, index_.size());
  }

  std::vector<Joint> join() {
    std::vector<Joint> joints;
    for (const Linkage& linkage : map_.linkages) {
      Joint& joint = joints.emplace_back();
      joint.from = index_.at(linkage.from);
      joint.to = index_.at(linkage.to);
      joint.exit = gates_.of_lane(joint.from).back();
      joint.entry = gates_.of_lane(joint.to).front();
      joint.welded = weld(joint);
      if (joint.welded) continue;
      const bool apart = !touches(joint, true) && !touches(joint, false);
      if (!apart || length(linkage.path) < kMinConnector_m)
        joint.entry = gates_.add_within(joint.to, kEntry_m);
    }
    return joints;
  }

 private:
  static std::size_t cut(const Gates::Gate& gate, bool left) { return left ? gate.left : gate.right; }
  /// Whether the lanes meet on one side.
  bool touches(const Joint& joint, bool left) {
    const std::size_t a = cut(joint.exit, left), b = cut(joint.entry, left);
    if (groups_.group(a) == groups_.group(b)) return true;
    if (gates_.cuts()[a].boundary == gates_.cuts()[b].boundary) return false;
    return (gates_.position(a) - gates_.position(b)).norm() <= kWeld_m && groups_.may_join(a, b);
  }
  bool weld(const Joint& joint) {
    if (!touches(joint, true) || !touches(joint, false)) return false;
    for (const bool left : {true, false}) groups_.join(cut(joint.exit, left), cut(joint.entry, left));
    return true;
  }

  const LocalMap& map_;
  Gates& gates_;
  NodeGroups& groups_;
  std::map<ElementId, std::size_t> index_;
};

/// The turn of a linkage across an intersection. A linkage that only bridges a gap of the road has none.
Linkage::Turn turn_of(const Linkage& linkage) {
  const bool along_markings =
      linkage.kind == Linkage::Kind::shared_boundary || linkage.kind == Linkage::Kind::geometric_alignment;
  return along_markings && linkage.turn == Linkage::Turn::straight ? Linkage::Turn::unknown : linkage.turn;
}

bool is_one_way(const Lane& lane) {
  return lane.direction != Lane::Direction::unknown && lane.direction != Lane::Direction::both;
}

void add_lanes(const LocalMap& map, const Gates& gates, NetworkBuilder& builder) {
  for (std::size_t i = 0; i < map.lanes.size(); ++i) {
    const Lane& lane = map.lanes[i];
    const std::vector<Gates::Gate>& row = gates.of_lane(i);
    for (std::size_t k = 0; k + 1 < row.size(); ++k)
      builder.add({.left = builder.stretch(row[k].left, row[k + 1].left),
                   .right = builder.stretch(row[k].right, row[k + 1].right),
                   .one_way = is_one_way(lane),
                   .use = lane.use,
                   .lane = lane.id,
                   .linkage = {},
                   .status = lane.status,
                   .existence_probability = lane.existence_probability});
  }
}

void add_connectors(const LocalMap& map, const std::vector<Joint>& joints, NetworkBuilder& builder) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = joints[i];
    if (joint.welded) continue;
    const Linkage& linkage = map.linkages[i];
    const auto [left, right] = builder.sides_between(joint.exit, joint.entry, linkage.path);
    builder.add({.left = left,
                 .right = right,
                 .one_way = is_one_way(map.lanes[joint.from]) || is_one_way(map.lanes[joint.to]),
                 .linkage = i,
                 .turn = turn_of(linkage),
                 .status = map.lanes[joint.to].status,
                 .existence_probability = linkage.probability});
  }
}

void add_stops(const LocalMap& map, NetworkBuilder& builder) {
  for (const Stopline& stopline : map.stoplines) {
    RoadNetwork::StopElement stop{.way = builder.free_way(stopline.marking), .lanelets = {}};
    for (const ElementId lane : stopline.lanes) stop.lanelets.push_back(builder.last_of(lane));
    builder.add(std::move(stop));
  }
}

}  // namespace

RoadNetwork weld(const LocalMap& published) {
  const LocalMap map = with_single_borders(published);
  Gates gates(map);
  NodeGroups groups(gates.cuts());
  const std::vector<Joint> joints = Joiner(map, gates, groups).join();
  gates.cut_at_styles();
  gates.carry_across();
  NetworkBuilder builder(map, gates, groups);
  add_lanes(map, gates, builder);
  add_connectors(map, joints, builder);
  add_stops(map, builder);
  builder.add_rest();
  RoadNetwork network = builder.take();
  separate_strays(map, network);
  return network;
}

}  // namespace laneloom::exports
