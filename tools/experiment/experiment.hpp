#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/map_evaluation.hpp"
#include "experiment/drive_simulation.hpp"
#include "experiment/peer.hpp"
#include "laneloom/config.hpp"

/// Drives through several subjects: all see the same frames, and are rated by the same truth.
namespace laneloom {

struct NamedConfig {
  std::string name;
  Config config;
};

struct ExperimentSpec {
  std::vector<DriveSpec> drives;
  std::vector<NamedConfig> configs;
  std::optional<Peer> peer;
  bool oracle = false;
  RangeConfig range;            ///< that is rated
  double min_confidence = 0.3;  ///< of the single detections that count
};

struct SubjectResult {
  std::string name;  ///< raw, a configuration's, peer, oracle
  Measures measures;
  Distribution update_ms;  ///< of mappers only
};

/// Of one drive: raw, the configurations, peer, oracle; those that were asked for, in this order.
using DriveResults = std::vector<SubjectResult>;

/// One per drive. They run on all cores at once; that changes no result but the times.
/// Throws what a drive throws.
std::vector<DriveResults> run(const ExperimentSpec& spec);

/// Of all drives together.
DriveResults sum(const std::vector<DriveResults>& drives);

}  // namespace laneloom
