#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "commands/commands.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/read_input.hpp"
#include "commands/warn_of.hpp"
#include "evaluation/inputs.hpp"
#include "io/json_lines.hpp"
#include "io/new_file.hpp"
#include "laneloom/objects.hpp"
#include "recording/topics.hpp"
#include "replay/message_source.hpp"
#include "support/progress_bar.hpp"

namespace laneloom::commands {
namespace {

/// The topics by their names without laneloom's prefix, as places in AnyMessage.
std::map<std::string, std::size_t> topics_by_name() {
  std::map<std::string, std::size_t> topics;
  for (std::size_t i = 0; i < recording::kTopicNames.size(); ++i) {
    const std::string name = recording::kTopicNames.at(i);
    topics[name.substr(name.rfind('/') + 1)] = i;
  }
  return topics;
}

const std::map<std::string, std::size_t> kTopics = topics_by_name();

struct CutOptions {
  std::string drive, out;
  double from_s = -std::numeric_limits<double>::infinity();
  double to_s = std::numeric_limits<double>::infinity();
  std::vector<std::string> topics;
  std::string compression = "zstd";
  bool strict = false;
};

/// What is to be kept, and how much was.
class Part {
 public:
  explicit Part(const CutOptions& options) : options_(options) {}

  /// Times count from this one on. If it is not set, they count from that of the first message.
  void set_begin(std::int64_t first_ns) { first_ns_ = first_ns; }

  /// Whether a message is kept.
  bool holds(std::int64_t stamp_ns) {
    if (!first_ns_) first_ns_ = stamp_ns;
    const double at_s = static_cast<double>(stamp_ns - *first_ns_) * 1e-9;
    const bool is_kept = at_s >= options_.from_s && at_s < options_.to_s;
    kept_ += is_kept ? 1 : 0;
    return is_kept;
  }
  bool holds(const recording::RawMessage& message) {
    if (!first_ns_) first_ns_ = message.log_time_ns;
    const auto is_it = [&](const std::string& name) { return kTopics.at(name) == message.topic; };
    return (options_.topics.empty() || std::ranges::any_of(options_.topics, is_it)) &&
           holds(message.log_time_ns);
  }
  std::size_t kept() const { return kept_; }

 private:
  const CutOptions& options_;
  std::optional<std::int64_t> first_ns_;
  std::size_t kept_ = 0;
};

/// Messages keep their bytes, refused ones as well.
void cut_to_recording(const CutOptions& options, Part& part) {
  const auto source = replay::open_messages(options.drive, "", {.strict = options.strict});
  recording::RecordingWriter out(options.out, {.compression = kCompressions.at(options.compression),
                                               .configuration = source->origin().configuration});
  support::ProgressBar bar;
  while (const auto message = source->next_raw()) {
    bar.step(source->progress());
    if (part.holds(*message)) out.write_raw(*message);
  }
  out.close();
  bar.clear();
  warn_of(options.drive, source->refused(), source->left_out());
}

/// Lines keep their text.
void cut_lines(const CutOptions& options, Part& part) {
  if (!options.topics.empty())
    throw std::runtime_error(options.drive + ": JSON lines have no topics; --topic needs a recording");
  io::JsonLinesReader reader(options.drive);
  io::JsonLinesWriter out(options.out);
  LeftOut left_out(options.strict);
  support::ProgressBar bar;
  while (const auto line = reader.next_stamped(left_out)) {
    bar.step(reader.progress());
    if (part.holds(line->stamp_ns)) out.write_line(line->text);
  }
  out.close();
  bar.clear();
  warn_of(options.drive, left_out);
}

/// The objects of a recording, which lines tell at the stamps of frames.
class ObjectsOfFrames {
 public:
  explicit ObjectsOfFrames(const std::string& recording) {
    support::ProgressBar bar;
    evaluation::for_each_objects(recording,
                                 [&](const TrackedObjects& seen, const Eigen::Isometry3d& T_map_body) {
                                   seen_.push_back(in_map_frame(seen, T_map_body));
                                 },
                                 {.on_step = [&](double share) { bar.step(share); }});
  }

  /// The newest since the last call, moved on to this stamp. Stamps must ascend.
  std::optional<TrackedObjects> at(std::int64_t stamp_ns) {
    std::optional<TrackedObjects> newest;
    while (!seen_.empty() && seen_.front().stamp_ns <= stamp_ns) {
      newest = std::move(seen_.front());
      seen_.pop_front();
    }
    return newest ? std::optional(moved_to(stamp_ns, *std::move(newest))) : std::nullopt;
  }

 private:
  std::deque<TrackedObjects> seen_;  ///< in the map frame; stamps ascend
};

/// The turns that a recording tells, which lines tell at the stamps of frames.
class TurnsOfFrames {
 public:
  explicit TurnsOfFrames(const std::string& recording) {
    evaluation::for_each_next_turn(recording, [&](const NextTurn& turn, const Eigen::Isometry3d& T_map_body) {
      told_.emplace_back(turn, T_map_body.translation());
    });
  }

  /// The newest since the last call, as it is from the vehicle's place at this stamp. Stamps must ascend.
  std::optional<NextTurn> at(std::int64_t stamp_ns, const Point& place) {
    std::optional<NextTurn> newest;
    for (; !told_.empty() && told_.front().first.stamp_ns <= stamp_ns; told_.pop_front()) {
      const auto& [turn, told_at] = told_.front();
      newest = turn;
      newest->distance_m = std::max(0.0, turn.distance_m - (place - told_at).head<2>().norm());
      newest->stamp_ns = stamp_ns;
    }
    return newest;
  }

 private:
  std::deque<std::pair<NextTurn, Point>> told_;  ///< with the vehicle's place; stamps ascend
};

/// When the first message of a recording came, by the clock of the stamps: as long before the first T as it
/// came before it.
template <class T>
std::optional<std::int64_t> begin_of(const std::string& recording) {
  const auto source = replay::open_messages(recording, "");
  std::optional<std::int64_t> first_ns;
  while (const auto message = source->next()) {
    if (!first_ns) first_ns = message->log_time_ns;
    if (std::holds_alternative<T>(message->message) && message->publish_time_ns > 0)
      return message->publish_time_ns - (message->log_time_ns - *first_ns);
  }
  return std::nullopt;
}

/// Writes the frames of a recording with their poses, objects and turns.
void cut_frames(const CutOptions& options, Part& part, io::JsonLinesWriter& out) {
  ObjectsOfFrames objects(options.drive);
  TurnsOfFrames turns(options.drive);
  for_each_frame(options.drive, options.strict,
                 [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
                   std::optional<TrackedObjects> seen = objects.at(frame.stamp_ns);
                   const auto turn = turns.at(frame.stamp_ns, T_map_body.translation());
                   if (!part.holds(frame.stamp_ns)) return;
                   out.write(io::FrameRecord{frame,
                                             {.stamp_ns = frame.stamp_ns,
                                              .position = T_map_body.translation(),
                                              .orientation = Eigen::Quaterniond(T_map_body.linear())},
                                             std::move(seen),
                                             turn});
                 });
}

/// Writes the frames of a recording, or else its maps.
void cut_to_lines(const CutOptions& options, Part& part) {
  const bool maps = options.topics == std::vector<std::string>{"lane_map"};
  if (!maps && !options.topics.empty())
    throw std::runtime_error(options.out +
                             ": JSON lines hold frames with their poses, or else maps (--topic lane_map)");
  const auto begin_ns =
      maps ? begin_of<PublishedMap>(options.drive) : begin_of<DetectionFrame>(options.drive);
  if (begin_ns) part.set_begin(*begin_ns);
  io::JsonLinesWriter out(options.out);
  if (maps)
    for_each_map(options.drive, options.strict, [&](const LocalMap& map) {
      if (part.holds(map.stamp_ns)) out.write(map);
    });
  else
    cut_frames(options, part, out);
  out.close();
}

void cut(const CutOptions& options) {
  if (!(options.from_s < options.to_s)) throw CLI::ValidationError("--to", "must be later than --from");
  refuse_overwriting({options.drive}, {options.out});
  Part part(options);
  io::make_file(options.out, [&] {
    if (options.out.ends_with(".mcap"))
      cut_to_recording(options, part);
    else if (recording::is_recording(options.drive))
      cut_to_lines(options, part);
    else
      cut_lines(options, part);
    if (part.kept() == 0) throw std::runtime_error(options.drive + ": nothing of it is in that part");
  });
  fmt::print("{}: {} messages\n", options.out, part.kept());
}

}  // namespace

void add_cut(CLI::App& app) {
  CLI::App* command = app.add_subcommand("cut", "Writes a part of a drive: some seconds, or some topics");
  const auto options = std::make_shared<CutOptions>();
  command
      ->add_option("--in,drive", options->drive,
                   "Recording (MCAP), or JSON lines of frames or maps; - is standard input")
      ->required();
  add_text_output(*command, "--out", options->out,
                  "File to write: .mcap, else JSON lines; - is standard output")
      ->required();
  command->add_option("--from", options->from_s, "Begin, in seconds since the first message")
      ->check(within(0.0, 1e9));
  command->add_option("--to", options->to_s, "End, likewise; the message at that time is not in it")
      ->check(within(0.0, 1e9));
  command->add_option("--topic", options->topics, "Topic to keep; once for each. Default: all")
      ->check(CLI::IsMember(kTopics));
  add_compression(*command, options->compression);
  add_strict(*command, options->strict);
  command->callback([options] { cut(*options); });
}

}  // namespace laneloom::commands
