#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/detection_model.hpp"
#include "mapping/lines/network_model.hpp"

namespace laneloom {

/// Tells how much of a frame is news. Views from one place err alike: from where the vehicle stands, all of
/// them together count as less than two.
class Standpoint {
 public:
  /// 1: an independent view.
  double news(const Point& origin);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(place_, views_);
  }

 private:
  Point place_ = Point::Zero();
  double views_ = 0.0;  ///< from there
};

/// What is known of a source of detections.
struct Network {
  std::string source;
  std::uint64_t frame = 0;   ///< the newest one
  NetworkModel lateral;      ///< where its lines lie
  DetectionModel detection;  ///< whether there are lines
  Standpoint standpoint;

  NetworkProfile profile() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(source, frame, lateral, detection, standpoint);
  }
};

/// The sources of detections, by number. Of too many sources, the one that was not heard of for longest is
/// forgotten.
class Networks {
 public:
  /// The number of a source, from which the `frame`-th frame comes.
  std::size_t number(const std::string& source, std::uint64_t frame, const MapperConfig& config);
  Network& operator[](std::size_t number) { return networks_[number]; }
  /// Null: nothing is known of that source.
  const Network* find(const std::string& source) const;
  const std::vector<Network>& all() const { return networks_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(networks_);
  }

 private:
  std::vector<Network> networks_;
};

/// Throws ConfigError where a profile of `config` has a value that no network has.
void check_profiles(const MapperConfig& config);

}  // namespace laneloom
