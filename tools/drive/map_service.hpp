#pragma once

#include <cstdint>

#include "session/mapping_session.hpp"

namespace laneloom::drive {

/// The lane map service for a vehicle. Times are by the sensor clock.
class MapService {
 public:
  virtual ~MapService() = default;
  virtual void send(const VehiclePose& pose) = 0;
  virtual void send(const DetectionFrame& frame, std::int64_t now_ns) = 0;
  virtual void send(const TrackedObjects& objects) = 0;
  virtual void send(const NextTurn& turn) = 0;
  /// The newest map. It has no lanes if there is none, or it is stale. The reference holds until the next
  /// call.
  virtual const LocalMap& newest(std::int64_t now_ns) = 0;
};

/// A mapping session within this process, without DDS.
class LocalMapService : public MapService {
 public:
  explicit LocalMapService(const Config& config) : session_(config) {}
  void send(const VehiclePose& pose) override { session_.add(pose); }
  void send(const DetectionFrame& frame, std::int64_t now_ns) override { session_.add(frame, now_ns); }
  void send(const TrackedObjects& objects) override { session_.add(objects); }
  void send(const NextTurn& turn) override { session_.add(turn); }
  const LocalMap& newest(std::int64_t now_ns) override {
    session_.expire(now_ns);
    return session_.map();
  }

 private:
  session::MappingSession session_;
};

}  // namespace laneloom::drive
