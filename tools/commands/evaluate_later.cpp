#include "commands/evaluate_later.hpp"

#include <map>
#include <utility>
#include <variant>

#include "commands/read_input.hpp"
#include "config/config_file.hpp"
#include "replay/replay.hpp"
#include "support/worker.hpp"

namespace laneloom::commands {
namespace {

/// Pairs each map with the frame after which it was made. A planner takes all maps, with frame or without.
class Pairs {
 public:
  explicit Pairs(LaterRating& rating) : rating_(rating) {}

  void add(const DetectionFrame& frame) { frames_.insert_or_assign(frame.stamp_ns, frame); }
  void add(const LocalMap& map) {
    if (map.stamp_ns > 0) rating_.steadiness.add(map);  // else: no frame was fused yet
    const auto frame = frames_.find(map.stamp_ns);
    if (frame == frames_.end()) return;
    rating_.later.add(frame->second, map.T_map_body, map);
    frames_.erase(frames_.begin(), std::next(frame));
  }

 private:
  LaterRating& rating_;
  std::map<std::int64_t, DetectionFrame> frames_;  // newer than the last map, by stamp
};

void rate_replay(const LaterInputs& inputs, Pairs& pairs) {
  const Config config = config::resolve_config(inputs.config, {});
  support::Worker worker;  // rates a map while the next one is made
  replay::Replay replay(config, [&](PublishedMap taken, std::int64_t /*log_time_ns*/) {
    worker.add([&, map = std::move(taken.map)] { pairs.add(map); });
  });
  for_each_input(inputs.in, config, inputs.strict, [&](recording::RecordedMessage&& message) {
    if (const auto* seen = std::get_if<DetectionFrame>(&message.message))
      worker.add([&, frame = *seen] { pairs.add(frame); });
    replay.add(std::move(message));
  });
  worker.finish();
}

void rate_files(const LaterInputs& inputs, Pairs& pairs) {
  std::map<std::int64_t, Eigen::Isometry3d> poses;  // of the frames, by stamp
  const auto add_frame = [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
    pairs.add(frame);
    poses.insert_or_assign(frame.stamp_ns, T_map_body);
  };
  for_each_frame(inputs.frames, inputs.strict, add_frame);
  for_each_map(inputs.map, inputs.strict, [&](const LocalMap& map) {
    const auto pose = poses.find(map.stamp_ns);
    if (pose != poses.end()) check_one_drive(pose->second, map, inputs.frames, inputs.map);
    pairs.add(map);
  });
}

}  // namespace

LaterRating evaluate_later(const LaterInputs& inputs) {
  LaterRating rating{evaluation::LaterMeter(inputs.min_confidence), {}};
  Pairs pairs(rating);
  inputs.in.empty() ? rate_files(inputs, pairs) : rate_replay(inputs, pairs);
  return rating;
}

}  // namespace laneloom::commands
