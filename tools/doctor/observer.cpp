#include "doctor/observer.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>
#include <utility>

#include "base/clock.hpp"
#include "base/seconds.hpp"
#include "doctor/host.hpp"
#include "laneloom/error.hpp"
#include "status/report.hpp"

namespace laneloom::doctor {
namespace {

using status::setting;

constexpr const char* kName = "laneloom doctor";
/// Most sessions of one vehicle within one observation. Further ones are not taken for services.
constexpr std::size_t kMaxSessions = 64;
/// Most names of sources, or writers of a source, that are told apart. A perception stack has a few.
constexpr std::size_t kMaxTold = 64;
/// Most messages that are kept, to see whether they fit together: some minutes of driving.
constexpr std::size_t kMostFrames = 2000, kMostPoses = 20000;

double offset_s(const ServiceStatus& status) {
  return seconds(system_now_ns()) - seconds(status.published_ns);
}

/// Reads the profile that the service names, in case that it is on this host.
void judge_profile(ServiceObserved& service) {
  DdsConfig config;
  config.profile_file = setting(service.last, "dds.profile_file");
  config.profile_name = setting(service.last, "dds.profile_name");
  service.profile_file = config.profile_file;
  if (config.profile_file.empty()) return;
  try {
    service.largest_datagram = dds::largest_datagram(config);
  } catch (const ConfigError&) {
    service.largest_datagram.reset();
  }
}

}  // namespace

void Observer::Stream::note(const dds::WriterId& by, const std::optional<dds::CdrHeader>& newest) {
  const bool is_first = observed.messages++ == 0;
  if (is_first) first = SteadyClock::now();
  if (by != writer && writers.contains(by)) observed.mixed.insert({by, writer});
  if (writers.size() < kMaxTold) writers.insert(by);
  writer = by;
  if (!newest) return;
  const bool same = newest->sequence == header.sequence && newest->session_id == header.session_id;
  if (!is_first && same) ++observed.unnumbered;
  header = *newest;
  observed.newest = {newest->stamp_ns,
                     std::chrono::nanoseconds(SteadyClock::now().time_since_epoch()).count()};
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
      detections_(participant_, [this](const dds::WriterId& writer,
                                       Bytes&& message) { receive_detections(writer, message); }),
      poses_(participant_,
             [this](const dds::WriterId& writer, Bytes&& message) { receive_pose(writer, message); }),
      objects_(participant_,
               [this](const dds::WriterId& writer, Bytes&& message) {
                 receive_optional<TrackedObjects>(objects_stream_, writer, message);
               }),
      next_turns_(participant_,
                  [this](const dds::WriterId& writer, Bytes&& message) {
                    receive_optional<NextTurn>(next_turns_stream_, writer, message);
                  }),
      statuses_(participant_, {.sample = [this](ServiceStatus&& status) { receive(std::move(status)); }}) {}

void Observer::receive_detections(const dds::WriterId& writer, const Bytes& message) {
  DetectionFrame frame;
  const std::lock_guard lock(mutex_);
  const auto header = dds::header_of(message);
  detections_stream_.note(writer, header);
  const auto refusal = dds::from_cdr(message, config_.map_frame_id, frame);
  if (!refusal.empty()) {
    ++detections_stream_.observed.refused[std::string(refusal)];
  } else if (sources_.size() < kMaxTold || sources_.contains(frame.source)) {
    Stream& source = sources_[frame.source];
    source.note(writer, header);
    if (frame.field_of_view.empty()) ++source.observed.without_view;
    for (const Detection& detection : frame.detections)
      source.observed.best_confidence = std::max(source.observed.best_confidence, detection.confidence);
    std::vector<DetectionFrame>& frames = drive_.frames[frame.source];
    if (frames.size() < kMostFrames) frames.push_back(std::move(frame));
  }
}

void Observer::receive_pose(const dds::WriterId& writer, const Bytes& message) {
  VehiclePose pose;
  const std::lock_guard lock(mutex_);
  poses_stream_.note(writer, dds::header_of(message));
  const auto refusal = dds::from_cdr(message, config_.map_frame_id, pose);
  if (!refusal.empty())
    ++poses_stream_.observed.refused[std::string(refusal)];
  else if (drive_.poses.size() < kMostPoses)
    drive_.poses.push_back(pose);
}

template <class T>
void Observer::receive_optional(Stream& stream, const dds::WriterId& writer, const Bytes& message) {
  T value;
  const std::lock_guard lock(mutex_);
  stream.note(writer, dds::header_of(message));
  const auto refusal = dds::from_cdr(message, config_.map_frame_id, value);
  if (!refusal.empty()) ++stream.observed.refused[std::string(refusal)];
}

/// Takes over the map frame of the service's configuration, which may differ from the doctor's.
void Observer::take_configuration(const ServiceStatus& status) {
  const std::string frame_id = setting(status, "dds.map_frame_id");
  if (frame_id.empty() || frame_id == config_.map_frame_id) return;
  config_.map_frame_id = frame_id;
  detections_stream_.observed.refused.erase("wrong_frame");
  poses_stream_.observed.refused.erase("wrong_frame");
}

void Observer::receive(ServiceStatus&& status) {
  const double offset = offset_s(status);
  const std::lock_guard lock(mutex_);
  take_configuration(status);
  auto found = services_.find(status.session_id);
  if (found == services_.end()) {
    if (services_.size() == kMaxSessions) return;
    found = services_.emplace(status.session_id, ServiceObserved{.first = status, .clock_offset_s = offset})
                .first;
  }
  ServiceObserved& service = found->second;
  if (std::abs(offset) < std::abs(service.clock_offset_s)) service.clock_offset_s = offset;
  service.last = std::move(status);
  ++service.statuses;
}

Observed Observer::observed() const {
  Observed result;
  result.largest_datagram = dds::largest_datagram(config_);
  result.discovery_servers = dds::discovery_servers(config_);
  result.participants = discovery_.participants();
  std::erase_if(result.participants, [](const dds::Peer& peer) { return peer.name == kName; });
  result.endpoints = discovery_.endpoints();
  std::erase_if(result.endpoints,
                [](const dds::Endpoint& endpoint) { return endpoint.participant.name == kName; });
  std::ifstream sockets("/proc/net/udp");
  result.listening_domains = listening_domains(sockets);
  result.shared_memory = shared_memory_files("/dev/shm", "/proc");
  result.service_processes = service_processes("/proc", config_.domain);

  const auto now = SteadyClock::now();
  const std::lock_guard lock(mutex_);
  result.dds = config_;
  result.duration_s = std::chrono::duration<double>(now - start_).count();
  result.detections = detections_stream_.until(now);
  result.poses = poses_stream_.until(now);
  result.objects = objects_stream_.until(now);
  result.next_turns = next_turns_stream_.until(now);
  result.drive = drive_;
  for (const auto& [name, stream] : sources_) result.sources.emplace(name, stream.until(now));
  result.services.reserve(services_.size());
  for (const auto& [session, service] : services_) result.services.push_back(service);
  std::ranges::for_each(result.services, judge_profile);
  return result;
}

}  // namespace laneloom::doctor
