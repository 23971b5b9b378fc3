#include "replay/map_output.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include "io/json_lines.hpp"

namespace laneloom::replay {
namespace {

class RecordedMaps : public MapOutput {
 public:
  RecordedMaps(const std::string& path, const recording::RecordingOptions& options)
      : writer_(path, options) {}

  void write(const PublishedMap& map, std::int64_t log_time_ns) override {
    writer_.write(map, log_time_ns);
    writer_.write(road_markings(map), log_time_ns);
  }
  void close() override { writer_.close(); }

 private:
  recording::RecordingWriter writer_;
};

class MapLines : public MapOutput {
 public:
  explicit MapLines(const std::string& path) : writer_(path) {}

  void write(const PublishedMap& map, std::int64_t /*log_time_ns*/) override { writer_.write(map.map); }
  void close() override { writer_.close(); }

 private:
  io::JsonLinesWriter writer_;
};

}  // namespace

struct Digest::State {
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> xxh3{XXH3_createState()};
};

Digest::Digest() : state_(std::make_unique<State>()) { XXH3_128bits_reset(state_->xxh3.get()); }
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;
Digest::~Digest() = default;

void Digest::add(const std::vector<std::uint8_t>& bytes) {
  XXH3_128bits_update(state_->xxh3.get(), bytes.data(), bytes.size());
}

std::string Digest::text() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh3.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::unique_ptr<MapOutput> create_map_output(const std::string& path,
                                             const recording::RecordingOptions& options) {
  if (path.ends_with(".mcap")) return std::make_unique<RecordedMaps>(path, options);
  return std::make_unique<MapLines>(path);
}

RoadMarkings road_markings(const PublishedMap& map) {
  return {map.map.stamp_ns, map.sequence, map.session_id, map.frame_id, map.map.markings};
}

}  // namespace laneloom::replay
