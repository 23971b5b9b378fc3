#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "simulation/frame_noise.hpp"
#include "simulation/ghosts.hpp"
#include "simulation/line_noise.hpp"
#include "simulation/noise_profile.hpp"
#include "simulation/occlusion.hpp"
#include "simulation/places.hpp"
#include "simulation/random.hpp"
#include "simulation/road.hpp"
#include "simulation/sensor_view.hpp"

namespace laneloom::simulation {

/// Simulates the detections of a network: every marking in view, as lines of about twenty points in the body
/// frame, with errors that last over frames (see NoiseProfile). The same road, profile, view, seed and poses
/// give the same frames. Not thread-safe.
class Perception {
 public:
  Perception(const Road& road, NoiseProfile noise, SensorView view, std::uint64_t seed);

  /// The frame seen from `pose`, at its stamp. Sequences count from 1. Poses come in the order of stamps. If
  /// one does not (in a new lap, say), or after a gap of a second, the errors go on as if a tenth of a second
  /// had passed.
  DetectionFrame observe(const VehiclePose& pose);

  /// The true marking of every detection of the last frame. kNoElement: it is a ghost.
  const std::vector<ElementId>& sources() const { return sources_; }

 private:
  // A piece of a marking, for as long as it stays in view.
  struct Track {
    std::size_t marking;
    Stretch arc;
    LineNoise noise;
  };

  double step_time(std::int64_t stamp_ns);
  Track& follow(std::vector<Track>& now, std::size_t marking, const VisiblePiece& piece, double dt_s);
  std::vector<VisiblePiece> found_parts(std::size_t marking, const VisiblePiece& piece) const;
  std::vector<Polyline> detect_markings(const VehiclePose& pose, double dt_s, DetectionFrame& frame);
  void detect(std::size_t marking, const LineNoise& line, const VisiblePiece& piece, DetectionFrame& frame);
  void add(const Detection& detection, ElementId source, DetectionFrame& frame);

  NoiseProfile noise_;
  SensorView view_;
  Random random_;
  std::vector<RoadMarking> markings_;
  std::vector<ViewedLine> lines_;  // of the markings
  std::vector<Places> places_;     // likewise
  std::vector<Track> tracks_;
  Ghosts ghosts_;
  Occluders occluders_;
  FrameNoise frame_noise_;
  std::optional<std::int64_t> last_stamp_ns_;
  std::uint64_t sequence_ = 0;
  std::vector<ElementId> sources_;
};

}  // namespace laneloom::simulation
