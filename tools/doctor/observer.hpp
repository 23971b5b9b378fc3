#pragma once

#include <chrono>
#include <map>
#include <mutex>

#include "doctor/observed.hpp"
#include "laneloom/dds/reader.hpp"

namespace laneloom {

/// Watches a domain and what one vehicle's topics carry, as a participant of its own.
class Observer {
 public:
  /// Begins at once. Throws as dds::Participant does.
  explicit Observer(const DdsConfig& config);

  /// What was seen so far.
  Observed observed() const;

 private:
  using SteadyClock = std::chrono::steady_clock;

  /// One input, while messages arrive.
  struct Stream {
    InputObserved observed;
    SteadyClock::time_point first;

    void note_arrival();
    InputObserved until(SteadyClock::time_point now) const;
  };

  template <class T>
  dds::ReaderCallbacks<T> callbacks_into(Stream& stream);
  void receive(ServiceStatus&& status);

  DdsConfig config_;
  SteadyClock::time_point start_ = SteadyClock::now();
  mutable std::mutex mutex_;
  Stream detections_stream_, poses_stream_;
  std::map<std::uint64_t, ServiceObserved> services_;  ///< by session
  dds::Discovery discovery_;
  dds::Participant participant_;
  dds::Reader<DetectionFrame> detections_;
  dds::Reader<VehiclePose> poses_;
  dds::Reader<ServiceStatus> statuses_;
};

}  // namespace laneloom
