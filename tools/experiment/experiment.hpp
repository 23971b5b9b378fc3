#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/map_evaluation.hpp"
#include "experiment/drive_simulation.hpp"
#include "experiment/peer.hpp"
#include "laneloom/config.hpp"

/// Experiments with several subjects. All get the same frames, and are rated by the same truth.
namespace laneloom::experiment {

/// A configuration of the mapper that is a subject.
struct NamedConfig {
  std::string name;
  Config config;
};

/// The drives and the subjects of an experiment.
struct ExperimentSpec {
  std::vector<DriveSpec> drives;
  std::vector<NamedConfig> configs;
  std::optional<Peer> peer;
  bool oracle = false;
  RangeConfig range;            ///< the range that is rated
  double min_confidence = 0.3;  ///< single detections with less are not rated
};

/// The result of one subject.
struct SubjectResult {
  std::string name;  ///< raw, a configuration's, peer, oracle
  evaluation::Measures measures;
  Distribution update_ms;  ///< times of updates; only of mappers
};

/// The results of one drive: those of raw, the configurations, peer and oracle that were asked for, in this
/// order.
using DriveResults = std::vector<SubjectResult>;

/// Runs all drives, on all cores at once. This changes no result except the times. Returns the results per
/// drive. Throws the exception of a drive that fails.
std::vector<DriveResults> run(const ExperimentSpec& spec);

/// The results of all drives together.
DriveResults sum(const std::vector<DriveResults>& drives);

}  // namespace laneloom::experiment
