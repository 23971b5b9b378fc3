#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/detection_model.hpp"
#include "mapping/lines/network_model.hpp"

namespace laneloom::lines {

/// Tells how much of a frame is news. Views from one place err alike. All views from where the vehicle stands
/// together count less than two. After two seconds of them, a view each second is enough.
class Standpoint {
 public:
  /// Whether a view from `origin` need not be taken: it tells next to nothing after those before.
  bool has_seen(const Point& origin, std::int64_t stamp_ns) const;
  /// Takes a view from `origin`. Returns its weight, 0..1. 1 is an independent view.
  double news(const Point& origin, std::int64_t stamp_ns);
  /// The least weight of the view that was taken last, at a place that is not confirmed yet.
  double least_news() const;
  /// Moves the place with the map.
  void move(const Eigen::Isometry3d& motion) { place_ = motion * place_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(place_, views_, last_view_ns_, paused_);
  }

 private:
  bool stands(const Point& origin) const;
  bool follows(std::int64_t stamp_ns) const;  ///< within a second

  Point place_ = Point::Zero();
  double views_ = 0.0;             ///< number of views that were taken from that place
  std::int64_t last_view_ns_ = 0;  ///< stamp of the newest of these
  bool paused_ = false;            ///< before that one, no view was taken for a second
};

/// The stretch of a frame, per metre ahead, in two parts: see PitchHistory::parts().
struct PitchParts {
  double sudden_per_m = 0.0, lasting_per_m = 0.0;
};

/// The stretch of a network's frames. A stretch that lasts may be that of a wrong pitch, or that of a road
/// whose lines draw together.
class PitchHistory {
 public:
  /// The difference of a frame's stretch to those before, and the mean of these.
  PitchParts parts(double stretch_per_m) {
    const PitchParts parts{stretch_per_m - mean_per_m_,
                           std::clamp(mean_per_m_, -kMostLasting_per_m, kMostLasting_per_m)};
    mean_per_m_ += kNewest * parts.sudden_per_m;
    return parts;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mean_per_m_);
  }

 private:
  static constexpr double kNewest = 0.25;              // weight of a frame
  static constexpr double kMostLasting_per_m = 0.003;  // of a pitch; a taper's is more
  double mean_per_m_ = 0.0;
};

/// A source of detections, with the models of its network.
struct Network {
  std::string source;        ///< name that its frames carry
  std::uint64_t frame = 0;   ///< number of its newest frame
  NetworkModel lateral;      ///< how it errs in the lateral place of lines
  DetectionModel detection;  ///< how well it tells whether there are lines
  Standpoint standpoint;     ///< of its views
  PitchHistory pitch;        ///< suspected of its frames

  NetworkProfile profile() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(source, frame, lateral, detection, standpoint, pitch);
  }
};

/// The sources of detections, by number. When there are too many, the one that was silent for longest is
/// forgotten.
class Networks {
 public:
  /// The number of the source from which frame number `frame` comes. A source that is not known is added.
  std::size_t number(const std::string& source, std::uint64_t frame, const MapperConfig& config);
  Network& operator[](std::size_t number) { return networks_[number]; }
  /// Null: nothing is known of that source.
  const Network* find(const std::string& source) const;
  const std::vector<Network>& all() const { return networks_; }
  /// Forgets where the sources saw from, for a map that begins anew.
  void forget_places() {
    for (Network& network : networks_) network.standpoint = {};
  }
  /// Moves the places that the sources saw from, map frame.
  void move(const Eigen::Isometry3d& motion) {
    for (Network& network : networks_) network.standpoint.move(motion);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(networks_);
  }

 private:
  std::vector<Network> networks_;
};

/// Throws ConfigError where a profile of `config` names a value that no network has.
void check_profiles(const MapperConfig& config);

}  // namespace laneloom::lines
