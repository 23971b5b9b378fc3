#include "doctor/observer.hpp"

#include <cmath>
#include <fstream>
#include <utility>

#include "doctor/host.hpp"

namespace laneloom {
namespace {

constexpr const char* kName = "laneloom doctor";
/// Of one vehicle within one observation; more are no services.
constexpr std::size_t kMaxSessions = 64;

template <class Clock>
std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

double offset_s(const ServiceStatus& status) {
  return static_cast<double>(now_ns<std::chrono::system_clock>()) / 1e9 -
         static_cast<double>(status.published_ns) / 1e9;
}

}  // namespace

void Observer::Stream::note_arrival() {
  if (observed.messages++ == 0) first = SteadyClock::now();
}

InputObserved Observer::Stream::until(SteadyClock::time_point now) const {
  InputObserved result = observed;
  if (result.messages > 0) result.window_s = std::chrono::duration<double>(now - first).count();
  return result;
}

Observer::Observer(const DdsConfig& config)
    : config_(config),
      discovery_(config, kName),
      participant_(config, kName),
      detections_(participant_, callbacks_into<DetectionFrame>(detections_stream_)),
      poses_(participant_, callbacks_into<VehiclePose>(poses_stream_)),
      statuses_(participant_, {.sample = [this](ServiceStatus&& status) { receive(std::move(status)); }}) {}

template <class T>
dds::ReaderCallbacks<T> Observer::callbacks_into(Stream& stream) {
  dds::ReaderCallbacks<T> callbacks;
  callbacks.sample = [this, &stream](T&& message) {
    const std::lock_guard lock(mutex_);
    stream.note_arrival();
    stream.observed.newest = {message.stamp_ns, now_ns<SteadyClock>()};
  };
  callbacks.refused = [this, &stream](std::string_view reason) {
    const std::lock_guard lock(mutex_);
    stream.note_arrival();
    ++stream.observed.refused[std::string(reason)];
  };
  return callbacks;
}

void Observer::receive(ServiceStatus&& status) {
  const double offset = offset_s(status);
  const std::lock_guard lock(mutex_);
  auto found = services_.find(status.session_id);
  if (found == services_.end()) {
    if (services_.size() == kMaxSessions) return;
    found = services_.emplace(status.session_id, ServiceObserved{status, {}, offset}).first;
  }
  ServiceObserved& service = found->second;
  if (std::abs(offset) < std::abs(service.clock_offset_s)) service.clock_offset_s = offset;
  service.last = std::move(status);
  ++service.statuses;
}

Observed Observer::observed() const {
  Observed result;
  result.dds = config_;
  result.participants = discovery_.participants();
  std::erase_if(result.participants, [](const dds::Peer& peer) { return peer.name == kName; });
  result.endpoints = discovery_.endpoints();
  std::erase_if(result.endpoints,
                [](const dds::Endpoint& endpoint) { return endpoint.participant.name == kName; });
  std::ifstream sockets("/proc/net/udp");
  result.listening_domains = listening_domains(sockets);
  result.shared_memory = shared_memory_files("/dev/shm", "/proc");

  const auto now = SteadyClock::now();
  const std::lock_guard lock(mutex_);
  result.duration_s = std::chrono::duration<double>(now - start_).count();
  result.detections = detections_stream_.until(now);
  result.poses = poses_stream_.until(now);
  result.services.reserve(services_.size());
  for (const auto& [session, service] : services_) result.services.push_back(service);
  return result;
}

}  // namespace laneloom
