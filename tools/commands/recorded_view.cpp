#include "commands/recorded_view.hpp"

#include <exception>
#include <filesystem>
#include <map>
#include <utility>
#include <variant>

#include "commands/evaluation_inputs.hpp"
#include "commands/stop_signal.hpp"
#include "drawing/drawing_json.hpp"
#include "drawing/truth.hpp"
#include "recording/recording.hpp"
#include "view/frame_text.hpp"

namespace laneloom {
namespace {

/// Ends the loading of a long file when the program is to end.
struct Stopped {};

/// Writes moments into a store.
class Storer {
 public:
  Storer(const RangeConfig& range, FrameStore& store) : range_(range), store_(store) {}

  void add(const ViewMoment& moment) {
    if (stop_requested()) throw Stopped();
    const FramePlace place{store_.size(), events_.next(moment)};
    store_.add(summary_text(moment, place), frame_text(moment, place, range_));
  }

 private:
  RangeConfig range_;
  FrameStore& store_;
  EventFinder events_;
};

void load_recording(const std::string& path, Storer& storer) {
  RecordingReader reader(path);
  MomentBuilder builder;
  while (auto recorded = reader.next()) {
    const auto add = [&](auto&& message) {
      return builder.add(std::forward<decltype(message)>(message), recorded->log_time_ns);
    };
    if (std::visit(add, std::move(recorded->message))) storer.add(builder.take());
  }
  if (const auto last = builder.finish()) storer.add(*last);
  warn_of(path, reader.refused(), reader.cut_off());
}

/// Frames and maps by their stamps; what one of the files lacks stays empty.
void load_files(const RecordedInputs& inputs, Storer& storer) {
  std::map<std::int64_t, ViewMoment> moments;
  const auto at = [&](std::int64_t stamp_ns) -> ViewMoment& {
    ViewMoment& moment = moments[stamp_ns];
    moment.has_state = false;
    moment.seen_ns = moment.map.map.stamp_ns = stamp_ns;
    return moment;
  };
  if (!inputs.frames.empty())
    for_each_frame(inputs.frames, [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
      ViewMoment& moment = at(frame.stamp_ns);
      moment.detections = frame;
      moment.map.map.T_map_body = T_map_body;
    });
  if (!inputs.maps.empty())
    for_each_map(inputs.maps, [&](const LocalMap& map) { at(map.stamp_ns).map.map = map; });
  for (const auto& [stamp_ns, moment] : moments) storer.add(moment);
}

}  // namespace

std::string RecordedInputs::title() const {
  const std::string& path = !recording.empty() ? recording : !maps.empty() ? maps : frames;
  return std::filesystem::path(path).filename().string();
}

std::string truth_elements(const RecordedInputs& inputs) {
  Drawing drawing;
  if (!inputs.truth.empty()) add_truth(load_truth(inputs.truth), drawing);
  return to_json(drawing)["elements"].dump();
}

void load(const RecordedInputs& inputs, const RangeConfig& range, FrameStore& store) {
  try {
    Storer storer(range, store);
    if (inputs.recording.empty())
      load_files(inputs, storer);
    else
      load_recording(inputs.recording, storer);
    store.finish(store.size() == 0 ? inputs.title() + ": there is nothing in it to show" : "");
  } catch (const std::exception& error) {
    store.finish(error.what());
  } catch (const Stopped&) {
    store.finish();
  }
}

}  // namespace laneloom
