#include "replay/replay.hpp"

#include <utility>
#include <variant>

#include "laneloom/dds/cdr.hpp"

namespace laneloom::replay {
namespace {

constexpr const char* kFrameId = "map";  // any name; both sides have the same

/// The message after its way over the wire, which live messages have gone: a pose's rotation may change in
/// its last bits.
template <class T>
T transmitted(const T& message) {
  std::vector<std::uint8_t> bytes;
  dds::to_cdr(message, kFrameId, bytes);
  T received;
  dds::from_cdr(bytes, kFrameId, received);
  return received;
}

template <class T>
std::string digest_of(const T& message) {
  std::vector<std::uint8_t> bytes;
  dds::to_cdr(message, kFrameId, bytes);
  Digest digest;
  digest.add(bytes);
  return digest.text();
}

std::string content_digest(const PublishedMap& map) {
  PublishedMap content;
  content.map = map.map;
  content.map.markings.clear();  // they are on the topic road_markings
  content.map.lineage.clear();
  return digest_of(content);
}

std::string content_digest(const RoadMarkings& markings) {
  return digest_of(RoadMarkings{.stamp_ns = markings.stamp_ns, .markings = markings.markings});
}

}  // namespace

Replay::Replay(const Config& config, MapTaker take_map, StageObserver* observer)
    : map_frame_id_(config.dds.map_frame_id), session_(config), take_map_(std::move(take_map)) {
  session_.observe(observer);
  session_.observe([this](const FusedFrame& fused, const LocalMap& map) { publish(fused, map); });
}

void Replay::add(recording::RecordedMessage message) {
  now_ns_ = message.log_time_ns;
  session_.expire(now_ns_);
  if (const auto* pose = std::get_if<VehiclePose>(&message.message)) session_.add(*pose);
  if (auto* frame = std::get_if<DetectionFrame>(&message.message)) session_.add(std::move(*frame), now_ns_);
  if (auto* objects = std::get_if<TrackedObjects>(&message.message)) session_.add(std::move(*objects));
  if (const auto* turn = std::get_if<NextTurn>(&message.message)) session_.add(*turn);
  session_.take_progress();
}

void Replay::publish(const FusedFrame& fused, const LocalMap& map) {
  PublishedMap published;
  published.sequence = maps_++;
  published.session_id = 1;
  published.frame_id = map_frame_id_;
  published.state = MapState::ok;
  published.fused_frames = {fused};
  published.map = map;
  published.published_ns = now_ns_;
  published.age_s = static_cast<double>(now_ns_ - session_.newest_arrival_ns().value_or(now_ns_)) * 1e-9;
  take_map_(std::move(published), now_ns_);
}

void MapHash::add(PublishedMap map) {
  map.published_ns = PublishedMap().published_ns;
  map.age_s = PublishedMap().age_s;
  dds::to_cdr(map, map.frame_id, cdr_);
  digest_.add(cdr_);
  dds::to_cdr(road_markings(map), map.frame_id, cdr_);
  digest_.add(cdr_);
}

void LiveComparison::add_live(const PublishedMap& map) {
  // Several maps of one stamp differ only in fields that are left out. Stamp 0 means that there is no map
  // yet.
  if (map.map.stamp_ns != 0) live_maps_[map.map.stamp_ns] = content_digest(map);
}

void LiveComparison::add_live(const RoadMarkings& markings) {
  if (markings.stamp_ns != 0) live_markings_[markings.stamp_ns] = content_digest(markings);
}

void LiveComparison::add_replayed(const PublishedMap& map) {
  maps_[map.map.stamp_ns] = content_digest(transmitted(map));
  markings_[map.map.stamp_ns] = content_digest(transmitted(road_markings(map)));
}

LiveComparison::Result LiveComparison::result() const {
  Result result;
  const auto compare = [&](const Digests& live, const Digests& replayed) {
    for (const auto& [stamp_ns, digest] : live) {
      const auto found = replayed.find(stamp_ns);
      ++(found == replayed.end()   ? result.missing
         : found->second == digest ? result.equal
                                   : result.different);
    }
  };
  compare(live_maps_, maps_);
  compare(live_markings_, markings_);
  result.began_late =
      !live_maps_.empty() && !maps_.empty() && live_maps_.begin()->first < maps_.begin()->first;
  return result;
}

}  // namespace laneloom::replay
