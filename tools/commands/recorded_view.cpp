#include "commands/recorded_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <exception>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include "commands/read_input.hpp"
#include "commands/recorded_configuration.hpp"
#include "commands/stop_signal.hpp"
#include "commands/warn_of.hpp"
#include "config/config_file.hpp"
#include "drawing/drawing_json.hpp"
#include "drawing/truth.hpp"
#include "recording/damage.hpp"
#include "recording/recording.hpp"
#include "replay/replay.hpp"
#include "support/progress_bar.hpp"
#include "view/frame_placer.hpp"
#include "view/frame_text.hpp"
#include "why/reason_history.hpp"

namespace laneloom::commands {
namespace {

constexpr double kTruthReach_m = 60.0;  ///< of the truth that is drawn around the vehicle

/// Is thrown to end the loading of a long file.
struct Stopped {};

/// Writes moments into a store.
class Storer {
 public:
  Storer(const RangeConfig& range, std::size_t maps, const simulation::Road* truth, view::FrameStore& store,
         std::stop_token stop)
      : range_(range), truth_(truth), placer_(range, maps, truth), store_(store), stop_(std::move(stop)) {}

  bool empty() const { return store_.size() == 0; }

  /// Throws Stopped if the loading is to end.
  void check() const {
    if (stop_requested() || stop_.stop_requested()) throw Stopped();
  }

  void add(view::ViewMoment moment) {
    check();
    if (truth_ != nullptr) moment.truth = drawing::map_of(*truth_, moment.map.map.T_map_body, kTruthReach_m);
    const view::FramePlace place = placer_.next(moment);
    store_.add(moment.seen_ns, summary_text(moment, place), frame_text(moment, place, range_));
  }

 private:
  RangeConfig range_;
  const simulation::Road* truth_;  ///< null: it is not known
  view::FramePlacer placer_;
  view::FrameStore& store_;
  std::stop_token stop_;
};

/// Maps a recording anew, to know why its maps are as they are. It knows that only of maps that come out the
/// same.
class Explainer {
 public:
  explicit Explainer(const Config& config)
      : replay_(
            config, [this](const PublishedMap& map, std::int64_t) { take(map.map); }, &reasons_) {}
  Explainer(const Explainer&) = delete;
  Explainer& operator=(const Explainer&) = delete;

  void add(const recording::RecordedMessage& message) { replay_.add(message); }

  nlohmann::json why(const LocalMap& map) const {
    const auto made = made_.find(map.stamp_ns);
    return made != made_.end() && made->second.ids == ids_of(map) ? made->second.why : nlohmann::json();
  }

 private:
  struct Made {
    std::vector<ElementId> ids;
    nlohmann::json why;
  };
  static constexpr std::size_t kKept = 64;

  static std::vector<ElementId> ids_of(const LocalMap& map) {
    std::vector<ElementId> ids;
    for (const Marking& boundary : map.boundaries) ids.push_back(boundary.id);
    for (const Lane& lane : map.lanes) ids.push_back(lane.id);
    return ids;
  }
  void take(const LocalMap& map) {
    made_[map.stamp_ns] = {ids_of(map), reasons_.to_json(map)};
    if (made_.size() > kKept) made_.erase(made_.begin());
  }

  why::ReasonHistory reasons_;
  std::map<std::int64_t, Made> made_;  ///< by stamp, the newest
  replay::Replay replay_;
};

/// Null if no map can be explained: the configuration that made the maps is of another version of laneloom,
/// or names a file that is not here.
std::unique_ptr<Explainer> explainer_of(const std::string& path) {
  try {
    return std::make_unique<Explainer>(recorded_config(path));
  } catch (const std::runtime_error& error) {
    fmt::print(stderr, "laneloom: {}; the view cannot tell why its maps are as they are\n", error.what());
    return nullptr;
  }
}

bool is_input(const recording::AnyMessage& message) {
  return std::holds_alternative<DetectionFrame>(message) || std::holds_alternative<VehiclePose>(message) ||
         std::holds_alternative<TrackedObjects>(message) || std::holds_alternative<NextTurn>(message);
}

/// Returns whether the recording has a map. If not, there is nothing of it in the store.
bool load_recording(const std::string& path, bool strict, Storer& storer) {
  recording::RecordingReader reader(path);
  const std::unique_ptr<Explainer> explainer = explainer_of(path);
  view::MomentBuilder builder;
  LeftOut left_out(strict);
  support::ProgressBar bar;
  while (auto recorded = recording::next_or_leave_out(left_out, [&] { return reader.next(); })) {
    storer.check();
    bar.step(reader.progress());
    const auto add = [&](auto&& message) {
      return builder.add(std::forward<decltype(message)>(message), recorded->log_time_ns);
    };
    if (explainer && is_input(recorded->message)) explainer->add(*recorded);
    if (!std::visit(add, std::move(recorded->message))) continue;
    view::ViewMoment moment = builder.take();
    if (explainer) moment.why = explainer->why(moment.map.map);
    storer.add(std::move(moment));
  }
  if (const auto last = builder.finish()) storer.add(*last);
  bar.clear();
  if (storer.empty()) return false;
  warn_of(path, reader.refused(), left_out);
  return true;
}

/// Maps one drive with several configurations, in step; or with a single one.
class Comparison {
 public:
  explicit Comparison(const std::vector<Config>& configs) : maps_(configs.size()) {
    for (std::size_t i = 0; i < configs.size(); ++i)
      replays_.emplace_back(
          configs[i],
          [this, i](const PublishedMap& map, std::int64_t) {
            maps_[i].push_back(map);
            if (i == 0) whys_.push_back(reasons_.to_json(map.map));
          },
          i == 0 ? &reasons_ : nullptr);
  }
  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;

  void add(const recording::RecordedMessage& message, Storer& storer) {
    for (replay::Replay& replay : replays_) replay.add(message);
    if (const auto* pose = std::get_if<VehiclePose>(&message.message))
      builder_.add(VehiclePose(*pose), message.log_time_ns);
    if (const auto* objects = std::get_if<TrackedObjects>(&message.message))
      builder_.add(TrackedObjects(*objects), message.log_time_ns);
    if (const auto* frame = std::get_if<DetectionFrame>(&message.message))
      builder_.add(DetectionFrame(*frame), message.log_time_ns);
    auto why = whys_.begin();
    for (PublishedMap& map : std::exchange(maps_.front(), {})) {
      view::ViewMoment moment = moment_of(std::move(map), message.log_time_ns);
      moment.why = std::move(*why++);
      storer.add(std::move(moment));
    }
    whys_.clear();
  }

 private:
  /// The moment of a map, with the newest map of each other configuration that is not later.
  view::ViewMoment moment_of(PublishedMap&& map, std::int64_t now_ns) {
    const std::int64_t stamp_ns = map.map.stamp_ns;
    RoadMarkings markings = replay::road_markings(map);
    builder_.add(std::move(map), now_ns);
    builder_.add(std::move(markings), now_ns);
    view::ViewMoment moment = builder_.take();
    moment.has_state = false;
    for (auto other = std::next(maps_.begin()); other != maps_.end(); ++other) {
      while (other->size() > 1 && (*other)[1].map.stamp_ns <= stamp_ns) other->pop_front();
      const bool is_there = !other->empty() && other->front().map.stamp_ns <= stamp_ns;
      moment.others.push_back(is_there ? other->front().map
                                       : LocalMap{.T_map_body = moment.map.map.T_map_body});
    }
    return moment;
  }

  why::ReasonHistory reasons_;                  ///< of the first configuration
  std::vector<nlohmann::json> whys_;            ///< of the maps of the first one
  std::vector<std::deque<PublishedMap>> maps_;  ///< per configuration; the last map of the others stays
  std::deque<replay::Replay> replays_;
  view::MomentBuilder builder_;
};

/// Maps a drive anew, by the defaults if there is no configuration.
void load_mapped(const RecordedInputs& inputs, Storer& storer) {
  std::vector<Config> configs;
  for (const std::string& path : inputs.configs) configs.push_back(config::load_config(path));
  if (configs.empty()) configs.emplace_back();
  Comparison comparison(configs);
  const auto add = [&](recording::RecordedMessage&& message) {
    storer.check();
    comparison.add(message, storer);
  };
  for_each_input(inputs.recording, configs.front(), inputs.strict, add);
}

/// Maps by their stamps.
std::map<std::int64_t, LocalMap> read_maps(const std::string& file, bool strict) {
  std::map<std::int64_t, LocalMap> maps;
  for_each_map(file, strict, [&](const LocalMap& map) { maps[map.stamp_ns] = map; });
  return maps;
}

/// Loads frames and maps by their stamps. A moment that one of the files lacks has no such part.
void load_files(const RecordedInputs& inputs, Storer& storer) {
  std::map<std::int64_t, view::ViewMoment> moments;
  const auto at = [&](std::int64_t stamp_ns) -> view::ViewMoment& {
    view::ViewMoment& moment = moments[stamp_ns];
    moment.has_state = false;
    moment.seen_ns = moment.map.map.stamp_ns = stamp_ns;
    return moment;
  };
  if (!inputs.frames.empty())
    for_each_frame(inputs.frames, inputs.strict,
                   [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
                     view::ViewMoment& moment = at(frame.stamp_ns);
                     moment.detections = frame;
                     moment.map.map.T_map_body = T_map_body;
                   });
  if (!inputs.maps.empty())
    for (auto& [stamp_ns, map] : read_maps(inputs.maps.front(), inputs.strict))
      at(stamp_ns).map.map = std::move(map);
  for (std::size_t i = 1; i < inputs.maps.size(); ++i) {
    const auto others = read_maps(inputs.maps[i], inputs.strict);
    for (auto& [stamp_ns, moment] : moments) {
      const auto later = others.upper_bound(stamp_ns);
      moment.others.push_back(later == others.begin() ? LocalMap{.T_map_body = moment.map.map.T_map_body}
                                                      : std::prev(later)->second);
    }
  }
  for (const auto& [stamp_ns, moment] : moments) storer.add(moment);
}

}  // namespace

std::string RecordedInputs::title() const {
  const std::string& path = !recording.empty() ? recording : !maps.empty() ? maps.front() : frames;
  return std::filesystem::path(path).filename().string();
}

std::vector<std::string> RecordedInputs::names() const {
  std::vector<std::string> names = configs.empty() ? maps : configs;
  if (names.empty()) names.push_back("map");
  if (!truth.empty()) names.emplace_back("truth");
  return names.size() > 1 ? names : std::vector<std::string>();
}

std::string truth_elements(const simulation::Road* truth) {
  drawing::Drawing drawing;
  if (truth != nullptr) add_truth(*truth, drawing);
  return to_json(drawing)["elements"].dump();
}

void load(const RecordedInputs& inputs, const RangeConfig& range, const simulation::Road* truth,
          view::FrameStore& store, const std::stop_token& stop) {
  try {
    const std::size_t maps = std::max({std::size_t{1}, inputs.configs.size(), inputs.maps.size()});
    Storer storer(range, maps, truth, store, stop);
    if (inputs.recording.empty())
      load_files(inputs, storer);
    else if (!inputs.configs.empty() || !recording::is_recording(inputs.recording) ||
             !load_recording(inputs.recording, inputs.strict, storer))
      load_mapped(inputs, storer);
    store.finish(store.size() == 0 ? inputs.title() + ": there is nothing in it to show" : "");
  } catch (const std::exception& error) {
    std::string complaint = error.what();
    if (!inputs.name.empty() && complaint.starts_with(inputs.recording))
      complaint.replace(0, inputs.recording.size(), inputs.name);
    store.finish(complaint);
  } catch (const Stopped&) {
    store.finish();
  }
}

}  // namespace laneloom::commands
