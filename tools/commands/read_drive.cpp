#include "commands/read_drive.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <variant>

#include "commands/read_input.hpp"
#include "commands/warn_of.hpp"
#include "recording/damage.hpp"
#include "recording/recording.hpp"
#include "replay/replay.hpp"
#include "support/progress_bar.hpp"

namespace laneloom::commands {
namespace {

/// Joins published maps to one drive.
class DriveReader {
 public:
  explicit DriveReader(const RangeConfig& range) : accumulator_(range) {}

  void take(const PublishedMap& published) {
    if (published.map.stamp_ns == 0) return;
    if (published.map.stamp_ns < stamp_ns_) {
      ++earlier_;
      return;
    }
    if (maps_ > 0 && published.map_id != map_id_) accumulator_.begin_anew();
    map_id_ = published.map_id;
    frame_id_ = published.frame_id;
    stamp_ns_ = published.map.stamp_ns;
    accumulator_.add(published.map);
    ++maps_;
  }
  std::size_t maps() const { return maps_; }
  /// Maps that came too late to be joined.
  std::size_t earlier() const { return earlier_; }
  ReadDrive finish() { return {accumulator_.finish(), frame_id_}; }

 private:
  exports::DriveAccumulator accumulator_;
  std::size_t maps_ = 0, earlier_ = 0;
  std::uint64_t map_id_ = 0;
  std::string frame_id_;
  std::int64_t stamp_ns_ = 0;
};

/// Whether the first line of JSON lines that can be read is a map.
bool holds_json_maps(const std::string& path) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);)
    if (const auto json = nlohmann::json::parse(line, nullptr, false); json.is_object())
      return json.contains("instances");
  return false;
}

void take_json_maps(const std::string& path, bool strict, DriveReader& taker) {
  for_each_map(path, strict, [&](const LocalMap& map) {
    PublishedMap published;
    published.map = map;
    taker.take(published);
  });
}

void take_recorded_maps(const std::string& path, bool strict, DriveReader& taker) {
  recording::RecordingReader reader(path);
  LeftOut left_out(strict);
  support::ProgressBar bar;
  while (const auto recorded = recording::next_or_leave_out(left_out, [&] { return reader.next(); })) {
    bar.step(reader.progress());
    if (const auto* published = std::get_if<PublishedMap>(&recorded->message)) taker.take(*published);
  }
  bar.clear();
  if (taker.maps() == 0) return;
  warn_of(path, reader.refused(), left_out);
  if (taker.earlier() > 0)
    fmt::print(stderr, "laneloom: {}: {} maps passed over: they are earlier than one before\n", path,
               taker.earlier());
}

void map_frames(const std::string& path, const Config& config, bool strict, DriveReader& taker) {
  replay::Replay replay(config,
                        [&](const PublishedMap& map, std::int64_t /*log_time_ns*/) { taker.take(map); });
  replay_input(path, config, strict, replay);
}

}  // namespace

ReadDrive read_drive(const std::string& path, const Config& config, bool strict) {
  DriveReader taker(config.mapper.range);
  const bool recorded = recording::is_recording(path);
  if (recorded) take_recorded_maps(path, strict, taker);
  if (!recorded && holds_json_maps(path)) take_json_maps(path, strict, taker);
  const bool has_maps = taker.maps() > 0;
  if (!has_maps) map_frames(path, config, strict, taker);
  if (taker.maps() == 0)
    throw std::runtime_error(path + ": has no maps, and no detections with poses to make them of");
  fmt::print("{}: {} maps {}\n", path, taker.maps(), has_maps ? "read" : "made of the detections");
  return taker.finish();
}

}  // namespace laneloom::commands
