#include "commands/live_view.hpp"

#include <chrono>
#include <utility>

#include "base/clock.hpp"
#include "commands/stop_signal.hpp"
#include "view/frame_text.hpp"

namespace laneloom::commands {

namespace {

/// For a tab that is opened after an incident.
constexpr view::StoreLimits kKeptFrames{.span_s = 300.0, .bytes = 10U << 20U};
/// To be saved as a recording.
constexpr view::StoreLimits kKeptMessages{.span_s = 60.0, .bytes = 8U << 20U};

}  // namespace

LiveView::LiveView(const DdsConfig& dds, const RangeConfig& range)
    : range_(range),
      placer_(range),
      scenes_(dds.map_frame_id),
      frames_(kKeptFrames),
      black_box_(dds, kKeptMessages),
      participant_(dds, "laneloom view"),
      detections_(participant_, into_inbox<DetectionFrame>()),
      poses_(participant_, into_inbox<VehiclePose>()),
      objects_(participant_, into_inbox<TrackedObjects>()),
      next_turns_(participant_, into_inbox<NextTurn>()),
      maps_(participant_, maps_into_inbox()),
      markings_(participant_, into_inbox<RoadMarkings>()),
      statuses_(participant_, into_inbox<ServiceStatus>()) {}

void LiveView::run(view::Site& site, view::WebServer& server, bool with_scenes) {
  while (!stop_requested()) {
    auto arrival = inbox_.take(std::chrono::milliseconds(50));
    if (!arrival) continue;
    if (const auto* alive = std::get_if<Alive>(&arrival->what)) {
      set_alive(alive->alive, arrival->time_ns);
    } else {
      auto& message = std::get<recording::AnyMessage>(arrival->what);
      if (const auto* status = std::get_if<ServiceStatus>(&message)) site.set_status(*status);
      black_box_.add(message, arrival->time_ns);
      if (with_scenes) publish_scenes(message, arrival->time_ns, server);
      if (!add(std::move(message), arrival->time_ns)) continue;
      shown_ = builder_.take();
      shown_->alive = alive_;
    }
    if (shown_) show(server);
  }
}

void LiveView::publish_scenes(const recording::AnyMessage& message, std::int64_t time_ns,
                              view::WebServer& server) {
  for (const scene::SceneMessage& scene : scenes_.take(message, time_ns))
    server.publish(static_cast<std::size_t>(scene.topic), time_ns,
                   std::string(scene.bytes.begin(), scene.bytes.end()));
}

bool LiveView::add(recording::AnyMessage&& message, std::int64_t time_ns) {
  const auto add = [&](auto&& any) { return builder_.add(std::forward<decltype(any)>(any), time_ns); };
  return std::visit(add, std::move(message));
}

/// Shows the last moment once more, with the new liveliness.
void LiveView::set_alive(bool alive, std::int64_t time_ns) {
  alive_ = alive;
  if (!shown_) return;
  shown_->alive = alive;
  shown_->repeated = true;
  shown_->seen_ns = time_ns;
  shown_->map.map.lineage.clear();
}

void LiveView::show(view::WebServer& server) {
  const view::FramePlace place = placer_.next(*shown_);
  std::string frame = frame_text(*shown_, place, range_);
  frames_.add(shown_->seen_ns, summary_text(*shown_, place), frame);
  server.publish(std::move(frame));
}

template <class T>
dds::ReaderCallbacks<T> LiveView::into_inbox() {
  return {.sample = [this](T&& message) {
    inbox_.put({recording::AnyMessage(std::move(message)), system_now_ns()});
  }};
}

dds::ReaderCallbacks<PublishedMap> LiveView::maps_into_inbox() {
  auto callbacks = into_inbox<PublishedMap>();
  callbacks.alive = [this](int writers) { inbox_.put({Alive{writers > 0}, system_now_ns()}); };
  return callbacks;
}

}  // namespace laneloom::commands
