#include "scene/scene_recording.hpp"

#include "recording/damage.hpp"

namespace laneloom::scene {

void write_scene(const std::vector<SceneMessage>& messages, std::int64_t log_time_ns,
                 recording::RecordingWriter& to) {
  for (const SceneMessage& message : messages)
    to.write_extra(static_cast<std::size_t>(message.topic), message.bytes, log_time_ns);
}

SceneRecordingReport add_scene(const std::string& from, const std::string& to,
                               const std::string& map_frame_id,
                               const std::function<void(double share)>& on_step) {
  recording::RecordingReader in(from, map_frame_id);
  recording::RecordingWriter out(to, {.map_frame_id = map_frame_id,
                                      .configuration = in.origin().configuration,
                                      .extra_topics = scene_topics()});
  SceneMaker maker(map_frame_id);
  SceneRecordingReport report;
  while (const auto message = recording::next_or_leave_out(report.left_out, [&] { return in.next_raw(); })) {
    out.write_raw(*message);
    const std::vector<SceneMessage> scenes = maker.take(*message);
    write_scene(scenes, message->log_time_ns, out);
    ++report.messages;
    report.scenes += scenes.size();
    on_step(in.progress());
  }
  out.close();
  report.refused = in.refused();
  return report;
}

}  // namespace laneloom::scene
