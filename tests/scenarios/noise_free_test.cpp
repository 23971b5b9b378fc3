#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "laneloom/mapper.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/perception.hpp"
#include "simulation/scenarios.hpp"

/// Perfect detections of every built-in road: every lane that was seen well enough is in the map, rightly
/// linked, and nothing else is.
namespace laneloom {
namespace {

constexpr double kSampleStep_m = 0.5;
constexpr double kEnds_m = 1.5;      // to which a lane's ends are known
constexpr int kFramesToBelieve = 5;  // until an inferred lane is shown
constexpr double kTolerance_m = 0.4;
constexpr double kMinLength_m =
    9.0;  // of what is in view: its ends are known to within a cross-section of 1 m
constexpr double kMaxHeight_m = 2.0;    // of a lane above or below the one that is compared
constexpr double kBorder_m = 2.0;       // of the range, where nothing is expected yet
constexpr std::size_t kEndSamples = 4;  // of a lane that count as its end

/// A place on a lane of the truth: its centre and its two borders, and in how many frames on end all of it
/// was in view.
struct CrossSection {
  Point center, left, right;
  int frames_in_view = 0;
};

struct TruthLane {
  const simulation::RoadLane* lane;
  std::vector<CrossSection> sections;
};

std::vector<CrossSection> cross_sections(const simulation::RoadLane& lane) {
  const MeasuredPolyline left(lane.left), right(lane.right);
  std::vector<CrossSection> sections;
  for (const Point& center : MeasuredPolyline(lane.centerline).resample(kSampleStep_m)) {
    sections.push_back({center, left.project(center).foot, right.project(center).foot});
  }
  return sections;
}

bool painted(const simulation::RoadLane& lane) {
  return !lane.in_intersection && (lane.left_marking != kNoElement || lane.right_marking != kNoElement);
}

using ScenarioAndMethod = std::tuple<std::string, std::string>;

class NoiseFree : public ::testing::TestWithParam<ScenarioAndMethod> {
 protected:
  static MapperConfig with_method(const std::string& method) {
    MapperConfig config;
    config.method = method == "voxels" ? FusionMethod::voxels : FusionMethod::lines;
    return config;
  }

  NoiseFree()
      : config_(with_method(std::get<1>(GetParam()))),
        road_(simulation::make_scenario(std::get<0>(GetParam()))),
        mapper_(config_) {
    for (const simulation::RoadLane& lane : road_.lanes) {
      all_centerlines_.emplace_back(lane.centerline);
      if (!painted(lane)) continue;
      truth_.push_back({&lane, cross_sections(lane)});
    }
  }

  /// The point in the body frame lies in the map's range, shrunk at its border by `inset_m`.
  bool in_range(const Point& map_point, double inset_m) const {
    const Point p = mapper_.map().T_map_body.inverse() * map_point;
    const RangeConfig& range = config_.range;
    return p.x() > range.forward_min_m + inset_m && p.x() < range.forward_max_m - inset_m &&
           std::abs(p.y()) < range.side_max_m - inset_m && std::abs(p.z()) < kMaxHeight_m;
  }

  bool in_range(const CrossSection& section, double inset_m) const {
    return in_range(section.left, inset_m) && in_range(section.right, inset_m);
  }

  void count_views() {
    for (TruthLane& truth : truth_) {
      for (CrossSection& section : truth.sections) {
        // A section that left the range was cleared, and is new when it comes again.
        section.frames_in_view =
            in_range(section, -config_.range.margin_side_m) ? section.frames_in_view + 1 : 0;
      }
    }
  }

  /// The published lane that covers a point, or null.
  static const Lane* cover(const LocalMap& map, const std::vector<MeasuredPolyline>& centerlines,
                           const Point& point) {
    for (std::size_t i = 0; i < map.lanes.size(); ++i) {
      const Projection foot = centerlines[i].project(point);
      if (foot.distance_m < kTolerance_m && std::abs(foot.foot.z() - point.z()) < kMaxHeight_m)
        return &map.lanes[i];
    }
    return nullptr;
  }

  void judge(const LocalMap& map) {
    std::vector<MeasuredPolyline> centerlines;
    for (const Lane& lane : map.lanes) centerlines.emplace_back(lane.centerline);
    std::map<ElementId, const Lane*> first_cover, last_cover;
    for (const TruthLane& truth : truth_) {
      double expected_m = 0.0, found_m = 0.0;
      const Lane* first = nullptr;
      const Lane* last = nullptr;
      for (std::size_t i = 0; i < truth.sections.size(); ++i) {
        const CrossSection& section = truth.sections[i];
        const bool seen = section.frames_in_view > config_.voxel_map.min_detections + 5;
        if (!seen || !in_range(section, kBorder_m)) continue;
        const Lane* lane = cover(map, centerlines, section.center);
        expected_m += kSampleStep_m;
        if (lane == nullptr) continue;
        found_m += kSampleStep_m;
        if (i < kEndSamples) first = lane;
        if (i + kEndSamples > truth.sections.size() && last == nullptr) last = lane;
      }
      expected_m_ += expected_m;
      found_m_ += found_m;
      if (expected_m < kMinLength_m) continue;
      ++lanes_expected_;
      if (first != nullptr) first_cover[truth.lane->id] = first;
      if (last != nullptr) last_cover[truth.lane->id] = last;
      int& missed = missed_[truth.lane->id];
      if (found_m >= 0.8 * expected_m - kEnds_m) {
        missed = 0;
      } else if (++missed > kFramesToBelieve) {
        ADD_FAILURE() << "at " << map.T_map_body.translation().transpose() << " lane " << truth.lane->id
                      << " of the truth is found on " << found_m << " of " << expected_m << " m";
      }
    }
    judge_successors(map, first_cover, last_cover);
    judge_inventions(map);
  }

  void judge_successors(const LocalMap& map, const std::map<ElementId, const Lane*>& first_cover,
                        const std::map<ElementId, const Lane*>& last_cover) {
    for (const auto& [id, from] : last_cover) {
      const simulation::RoadLane& lane = *std::ranges::find(road_.lanes, id, &simulation::RoadLane::id);
      for (const ElementId successor : lane.successors) {
        const auto to = first_cover.find(successor);
        if (to == first_cover.end()) continue;
        ++successors_expected_;
        if (continues(map, *from, *to->second)) {
          ++successors_found_;
        } else {
          ADD_FAILURE() << "at " << map.T_map_body.translation().transpose() << " lane " << id
                        << " of the truth goes on in " << successor << ", but " << from->id << " does not in "
                        << to->second->id;
        }
      }
    }
  }

  /// Whether `to` continues `from`. Linkages count in either direction: where nothing tells how traffic runs,
  /// lanes run as the section does. A lane that lies beside counts as well: once the line between them has
  /// begun, a lane that opens or ends is reached by changing to it.
  static bool continues(const LocalMap& map, const Lane& from, const Lane& to) {
    const bool beside = names(from.left_neighbours, to.id) || names(from.right_neighbours, to.id);
    return beside || reaches(map, from.id, to.id) || reaches(map, to.id, from.id);
  }

  static bool names(const std::vector<Neighbour>& neighbours, ElementId lane) {
    return std::ranges::find(neighbours, lane, &Neighbour::lane) != neighbours.end();
  }

  /// Within two linkages: a lane of the truth may be published in two pieces.
  static bool reaches(const LocalMap& map, ElementId from, ElementId to) {
    std::set<ElementId> reached{from};
    for (int hop = 0; hop < 2; ++hop) {
      std::set<ElementId> next = reached;
      for (const Linkage& l : map.linkages) {
        if (reached.contains(l.from)) next.insert(l.to);
      }
      reached = next;
    }
    return reached.contains(to);
  }

  void judge_inventions(const LocalMap& map) {
    for (const Lane& lane : map.lanes) {
      int invented = 0;
      for (const Point& p : lane.centerline) {
        const bool real = std::ranges::any_of(all_centerlines_, [&](const MeasuredPolyline& truth) {
          const Projection foot = truth.project(p);
          return foot.distance_m < kTolerance_m && std::abs(foot.foot.z() - p.z()) < kMaxHeight_m;
        });
        if (!real) ++invented;
      }
      // A lane that ends in another one is remembered a few metres further.
      EXPECT_LE(invented, std::max(6, static_cast<int>(lane.centerline.size()) / 5))
          << "at " << map.T_map_body.translation().transpose() << " lane " << lane.id
          << " is no lane of the truth";
    }
  }

  MapperConfig config_;
  simulation::Road road_;
  Mapper mapper_;
  std::vector<TruthLane> truth_;
  std::vector<MeasuredPolyline> all_centerlines_;
  double expected_m_ = 0.0, found_m_ = 0.0;
  int lanes_expected_ = 0;
  std::map<ElementId, int> missed_;  ///< per lane of the truth, the frames since it was found last
  int successors_expected_ = 0, successors_found_ = 0;
};

TEST_P(NoiseFree, EveryLaneIsFoundRightlyLinkedAndNoneInvented) {
  simulation::Perception perception(road_, simulation::noise_profile("none"), simulation::SensorView{}, 1);
  const double duration_s = road_.drive.duration_s();
  for (int i = 0; i < static_cast<int>(duration_s * 10.0); ++i) {
    const VehiclePose pose = road_.drive.pose_at(0.1 * i);
    const LocalMap& map = mapper_.update(perception.observe(pose), transform(pose));
    count_views();
    judge(map);
  }
  EXPECT_GT(lanes_expected_, 100);
  EXPECT_GT(found_m_, 0.98 * expected_m_);
  EXPECT_EQ(successors_found_, successors_expected_);
  if (const auto name = std::get<0>(GetParam()); name == "split" || name == "merge" || name == "town") {
    EXPECT_GT(successors_expected_, 20);
  }
}

/// The method of voxels does not tell lines apart that diverge as slowly as those of an exit.
std::vector<ScenarioAndMethod> drives() {
  std::vector<ScenarioAndMethod> drives;
  for (const std::string& name : simulation::scenario_names()) {
    drives.emplace_back(name, "lines");
    if (name != "exit") drives.emplace_back(name, "voxels");
  }
  return drives;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, NoiseFree, ::testing::ValuesIn(drives()), [](const auto& drive) {
  return std::get<0>(drive.param) + "_" + std::get<1>(drive.param);
});

}  // namespace
}  // namespace laneloom
