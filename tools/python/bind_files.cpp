#include <fmt/format.h>

#include "arguments.hpp"
#include "binding.hpp"
#include "evaluation/inputs.hpp"
#include "import/drive_recording.hpp"
#include "io/json_lines.hpp"
#include "stream.hpp"

namespace laneloom::python {
namespace {

using FrameStream = Stream<SeenFrame>;
using MapStream = Stream<LocalMap>;

constexpr const char* kReadFramesDoc =
    R"(The frames of a file, each with the pose at its stamp: [(Frame, Pose), ...].

path: JSON lines (.frames.jsonl) or a recording (.mcap); the first bytes tell which

Of a recording, these are the frames and poses that the service would believe; frames without poses around them are
left out. Frames come in the order of their stamps. What is passed over for another reason is a RuntimeWarning.
FileNotFoundError; RuntimeError: the file cannot be read or is malformed.)";

constexpr const char* kWriteFramesDoc = R"(Writes frames and their poses.

path: a recording where it ends with .mcap, which must not exist yet; else JSON lines (.frames.jsonl), written anew
frames: pairs (Frame, Pose); a pose is taken to be of its frame's stamp. Of a recording, stamps ascend

In a recording, sequences are counted up from 1, in session 1. RuntimeError: the file cannot be written.)";

constexpr const char* kReadMapsDoc = R"(The maps of a file: [LocalMap, ...], in the order of their stamps.

path: JSON lines or a recording (.mcap) of what the service published; the first bytes tell which

Of several maps of one stamp, it is the last. What is passed over is a RuntimeWarning.
FileNotFoundError; RuntimeError: the file cannot be read, or has nothing but malformed maps.)";

void warn(const std::string& text) {
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

void warn_of(const std::string& file, const evaluation::InputAccount& account) {
  for (const auto& [what, count] : account.refused.values())
    warn(fmt::format("{}: {} messages passed over: {}", file, count, what));
  if (account.count == 0 && !account.left_out.empty())
    throw std::runtime_error(file + ": nothing is left: " + account.left_out.summary());
  if (!account.left_out.empty()) warn(file + ": left out: " + account.left_out.summary());
  if (account.cut_off) warn(file + ": the recording is cut off");
}

VehiclePose pose_of(const Eigen::Isometry3d& T_map_body, std::int64_t stamp_ns) {
  return {.stamp_ns = stamp_ns,
          .position = T_map_body.translation(),
          .orientation = Eigen::Quaterniond(T_map_body.rotation()).normalized()};
}

py::list read_frames(const py::object& file) {
  const std::string name = existing_path(file, "path");
  std::vector<SeenFrame> frames;
  evaluation::InputAccount account;
  {
    const py::gil_scoped_release others_run;
    account = evaluation::for_each_frame(
        name, [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
          frames.push_back({frame, pose_of(T_map_body, frame.stamp_ns)});
        });
  }
  warn_of(name, account);
  py::list out;
  for (SeenFrame& seen : frames) out.append(py::make_tuple(std::move(seen.frame), std::move(seen.pose)));
  return out;
}

void write_recording(const std::string& file, const std::vector<SeenFrame>& seen) {
  std::vector<VehiclePose> poses;
  std::vector<DetectionFrame> frames;
  for (const auto& [frame, pose] : seen) {
    if (!frames.empty() && frame.stamp_ns <= frames.back().stamp_ns)
      throw py::value_error(fmt::format("frames[{}]: the stamps must ascend", frames.size()));
    poses.push_back(pose);
    poses.back().stamp_ns = frame.stamp_ns;
    frames.push_back(frame);
  }
  imports::write_drive(file, poses, frames);
}

void write_json_lines(const std::string& file, const std::vector<SeenFrame>& seen) {
  io::JsonLinesWriter out(file);
  for (const auto& [frame, pose] : seen) out.write(io::FrameRecord{frame, pose});
  out.close();
}

void write_frames(const py::object& file, const py::object& frames) {
  const std::string name = path(file, "path");
  const std::vector<SeenFrame> seen = list(frames, "frames", seen_frame);
  const py::gil_scoped_release others_run;
  if (name.ends_with(".mcap"))
    write_recording(name, seen);
  else
    write_json_lines(name, seen);
}

py::list read_maps(const py::object& file) {
  const std::string name = existing_path(file, "path");
  std::vector<LocalMap> maps;
  evaluation::InputAccount account;
  {
    const py::gil_scoped_release others_run;
    account = evaluation::for_each_map(name, [&](const LocalMap& map) { maps.push_back(map); });
  }
  warn_of(name, account);
  py::list out;
  for (LocalMap& map : maps) out.append(py::cast(std::move(map)));
  return out;
}

void write_maps(const py::object& file, const py::object& maps) {
  const std::string name = path(file, "path");
  if (name.ends_with(".mcap"))
    refuse_value("path", "maps are written as JSON lines (.jsonl), not as a recording");
  const std::vector<LocalMap> all = list(maps, "maps", instance<LocalMap>);
  const py::gil_scoped_release others_run;
  io::JsonLinesWriter out(name);
  for (const LocalMap& map : all) out.write(map);
  out.close();
}

py::object next_frame(FrameStream& stream) {
  std::optional<SeenFrame> seen;
  {
    const py::gil_scoped_release others_run;
    seen = stream.next();
  }
  if (seen) return py::make_tuple(std::move(seen->frame), std::move(seen->pose));
  warn_of(stream.file(), stream.account());
  throw py::stop_iteration();
}

py::object next_map(MapStream& stream) {
  std::optional<LocalMap> map;
  {
    const py::gil_scoped_release others_run;
    map = stream.next();
  }
  if (map) return py::cast(*std::move(map));
  warn_of(stream.file(), stream.account());
  throw py::stop_iteration();
}

std::unique_ptr<FrameStream> iter_frames(const py::object& file) {
  return std::make_unique<FrameStream>(
      existing_path(file, "path"), [](const std::string& name, const auto& put) {
        return evaluation::for_each_frame(
            name, [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
              put({frame, pose_of(T_map_body, frame.stamp_ns)});
            });
      });
}

std::unique_ptr<MapStream> iter_maps(const py::object& file) {
  return std::make_unique<MapStream>(
      existing_path(file, "path"), [](const std::string& name, const auto& put) {
        return evaluation::for_each_map(name, [&](const LocalMap& map) { put(map); });
      });
}

}  // namespace

void bind_files(py::module_& module) {
  using py::arg;
  const auto self = [](const py::object& stream) { return stream; };
  py::class_<FrameStream>(module, "FrameIterator", "The frames of a file, one after the other.")
      .def("__iter__", self)
      .def("__next__", &next_frame);
  py::class_<MapStream>(module, "MapIterator", "The maps of a file, one after the other.")
      .def("__iter__", self)
      .def("__next__", &next_map);
  module.def("iter_frames", &iter_frames, arg("path"),
             "The same as read_frames(), one after the other: a long file takes little memory.");
  module.def("iter_maps", &iter_maps, arg("path"),
             "The same as read_maps(), one after the other: a long file takes little memory.");
  module.def("read_frames", &read_frames, arg("path"), kReadFramesDoc);
  module.def("write_frames", &write_frames, arg("path"), arg("frames"), kWriteFramesDoc);
  module.def("read_maps", &read_maps, arg("path"), kReadMapsDoc);
  module.def("write_maps", &write_maps, arg("path"), arg("maps"),
             "Writes maps as JSON lines (.jsonl). RuntimeError: the file cannot be written.");
}

}  // namespace laneloom::python
