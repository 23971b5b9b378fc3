#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "commands/inbox.hpp"
#include "laneloom/config.hpp"
#include "laneloom/dds/reader.hpp"
#include "recording/recording.hpp"
#include "scene/scene_maker.hpp"
#include "view/black_box.hpp"
#include "view/frame_placer.hpp"
#include "view/frame_store.hpp"
#include "view/moment.hpp"
#include "view/site.hpp"
#include "view/web_server.hpp"

namespace laneloom::commands {

/// Shows the messages that a vehicle's participants exchange now. Not thread-safe.
class LiveView {
 public:
  /// `range` is the map's range box until the service tells its own. Throws std::runtime_error if DDS
  /// refuses.
  LiveView(const DdsConfig& dds, const RangeConfig& range);

  /// What was shown and heard lately. Thread-safe.
  const view::FrameStore& frames() const { return frames_; }
  const view::BlackBox& black_box() const { return black_box_; }

  /// Publishes frames, and scenes if the server has scene_topics(), until the program is to end.
  void run(view::Site& site, view::WebServer& server, bool with_scenes);

 private:
  /// Whether a writer of maps asserts its liveliness.
  struct Alive {
    bool alive = false;
  };
  /// An arrival, with its time (system clock).
  struct Arrival {
    std::variant<recording::AnyMessage, Alive> what;
    std::int64_t time_ns = 0;
  };

  void publish_scenes(const recording::AnyMessage& message, std::int64_t time_ns, view::WebServer& server);
  bool add(recording::AnyMessage&& message, std::int64_t time_ns);
  void set_alive(bool alive, std::int64_t time_ns);
  void show(view::WebServer& server);
  template <class T>
  dds::ReaderCallbacks<T> into_inbox();
  dds::ReaderCallbacks<PublishedMap> maps_into_inbox();

  RangeConfig range_;
  view::FramePlacer placer_;
  Inbox<Arrival> inbox_;
  scene::SceneMaker scenes_;
  view::FrameStore frames_;
  view::BlackBox black_box_;
  view::MomentBuilder builder_;
  std::optional<view::ViewMoment> shown_;
  bool alive_ = true;
  // They end before the inbox that they fill.
  dds::Participant participant_;
  dds::Reader<DetectionFrame> detections_;
  dds::Reader<VehiclePose> poses_;
  dds::Reader<TrackedObjects> objects_;
  dds::Reader<NextTurn> next_turns_;
  dds::Reader<PublishedMap> maps_;
  dds::Reader<RoadMarkings> markings_;
  dds::Reader<ServiceStatus> statuses_;
};

}  // namespace laneloom::commands
