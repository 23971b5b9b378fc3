#include "experiment/experiment.hpp"

#include <algorithm>
#include <chrono>

#include "experiment/oracle.hpp"
#include "experiment/parallel.hpp"
#include "laneloom/mapper.hpp"

namespace laneloom::experiment {
namespace {

void move(const Eigen::Isometry3d& T, Polyline& points) {
  for (Point& point : points) point = T * point;
}

/// Takes a map from the odometry's frame to the true one, such that it lies about the true vehicle as it did
/// about the odometry's.
LocalMap in_true_frame(LocalMap map, const SimulatedFrame& frame) {
  const Eigen::Isometry3d T = frame.T_map_body * transform(frame.record.pose).inverse();
  for (Marking& boundary : map.boundaries) move(T, boundary.points);
  for (Stopline& stopline : map.stoplines) move(T, stopline.marking.points);
  for (Lane& lane : map.lanes) {
    for (Polyline* line : {&lane.left, &lane.right, &lane.centerline}) move(T, *line);
  }
  for (Linkage& linkage : map.linkages) move(T, linkage.path);
  map.T_map_body = frame.T_map_body;
  return map;
}

class DriveRun {
 public:
  DriveRun(const ExperimentSpec& spec, const DriveSpec& drive)
      : spec_(spec), drive_(drive), frames_(simulate(drive)) {}

  DriveResults results() const {
    DriveResults all{raw()};
    for (const NamedConfig& config : spec_.configs) all.push_back(mapped(config));
    if (spec_.peer) all.push_back(peer());
    if (spec_.oracle) all.push_back(oracle());
    return all;
  }

 private:
  evaluation::MapEvaluation evaluation(evaluation::Subject subject) const {
    return {*drive_.road, spec_.range, subject};
  }

  SubjectResult raw() const {
    evaluation::MapEvaluation rated = evaluation(evaluation::Subject::detections);
    for (const SimulatedFrame& frame : frames_)
      rated.add(frame.record.frame, frame.T_map_body, spec_.min_confidence);
    return {"raw", rated.measures(), {}};
  }

  SubjectResult mapped(const NamedConfig& config) const {
    evaluation::MapEvaluation rated = evaluation(evaluation::Subject::maps);
    Mapper mapper(config.config.mapper);
    Distribution update_ms;
    for (const SimulatedFrame& frame : frames_) {
      const auto start = std::chrono::steady_clock::now();
      const Eigen::Isometry3d T_map_body = transform(frame.record.pose);
      if (frame.record.objects) mapper.add(*frame.record.objects, T_map_body);
      const LocalMap& map = mapper.update(frame.record.frame, T_map_body);
      update_ms.add(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
      rated.add(in_true_frame(map, frame));
    }
    return {config.name, rated.measures(), update_ms};
  }

  SubjectResult peer() const {
    evaluation::MapEvaluation rated = evaluation(evaluation::Subject::maps);
    std::vector<LocalMap> maps = run_peer(*spec_.peer, frames_);
    for (std::size_t i = 0; i < maps.size(); ++i) rated.add(in_true_frame(std::move(maps[i]), frames_[i]));
    return {"peer", rated.measures(), {}};
  }

  SubjectResult oracle() const {
    evaluation::MapEvaluation rated = evaluation(evaluation::Subject::maps);
    Oracle oracle(*drive_.road);
    for (const SimulatedFrame& frame : frames_) rated.add(oracle.update(frame));
    evaluation::Measures measures = rated.measures();
    // The oracle knows no lanes, so that it is not rated by them.
    measures.score.by_kind[index(evaluation::LineKind::lane)] = {};
    measures.top_ll = {};
    return {"oracle", measures, {}};
  }

  const ExperimentSpec& spec_;
  const DriveSpec& drive_;
  std::vector<SimulatedFrame> frames_;
};

}  // namespace

std::vector<DriveResults> run(const ExperimentSpec& spec) {
  std::vector<DriveResults> of_drive(spec.drives.size());
  in_parallel(spec.drives.size(),
              [&](std::size_t i) { of_drive[i] = DriveRun(spec, spec.drives[i]).results(); });
  return of_drive;
}

DriveResults sum(const std::vector<DriveResults>& drives) {
  DriveResults sums;
  for (const DriveResults& results : drives) {
    if (sums.empty()) {
      sums = results;
      continue;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i].measures += results[i].measures;
      sums[i].update_ms.add(results[i].update_ms);
    }
  }
  return sums;
}

}  // namespace laneloom::experiment
