#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "doctor/observed.hpp"
#include "laneloom/dds/cdr.hpp"
#include "laneloom/dds/raw_reader.hpp"
#include "laneloom/dds/reader.hpp"
#include "laneloom/objects.hpp"

namespace laneloom::doctor {

/// Watches a domain and the messages of one vehicle's topics, as a participant of its own.
class Observer {
 public:
  /// Begins to watch at once. Throws as dds::Participant does.
  explicit Observer(const DdsConfig& config);

  /// The observations so far.
  Observed observed() const;

 private:
  using SteadyClock = std::chrono::steady_clock;

  /// One input, while messages arrive.
  struct Stream {
    InputObserved observed;
    SteadyClock::time_point first;
    dds::CdrHeader header;  ///< of the newest message
    dds::WriterId writer{};
    std::set<dds::WriterId> writers;

    void note(const dds::WriterId& writer, const std::optional<dds::CdrHeader>& header);
    InputObserved until(SteadyClock::time_point now) const;
  };

  using Bytes = std::vector<std::uint8_t>;

  void receive_detections(const dds::WriterId& writer, const Bytes& message);
  void receive_pose(const dds::WriterId& writer, const Bytes& message);
  /// Takes a message of type T that the map can do without.
  template <class T>
  void receive_optional(Stream& stream, const dds::WriterId& writer, const Bytes& message);
  void receive(ServiceStatus&& status);
  void take_configuration(const ServiceStatus& status);

  DdsConfig config_;
  SteadyClock::time_point start_ = SteadyClock::now();
  mutable std::mutex mutex_;
  Stream detections_stream_, poses_stream_, objects_stream_, next_turns_stream_;
  std::map<std::string, Stream> sources_;
  std::map<std::uint64_t, ServiceObserved> services_;  ///< by session
  check::Drive drive_;
  dds::Discovery discovery_;
  dds::Participant participant_;
  dds::RawReader<DetectionFrame> detections_;
  dds::RawReader<VehiclePose> poses_;
  dds::RawReader<TrackedObjects> objects_;
  dds::RawReader<NextTurn> next_turns_;
  dds::Reader<ServiceStatus> statuses_;
};

}  // namespace laneloom::doctor
