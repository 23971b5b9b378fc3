#include <fmt/format.h>

#include <map>
#include <set>

#include "arguments.hpp"
#include "binding.hpp"
#include "evaluation/inputs.hpp"
#include "import/drive_recording.hpp"
#include "io/json_lines.hpp"
#include "stream.hpp"

namespace laneloom::python {
namespace {

using FrameStream = Stream<SeenFrame>;
using ObjectsStream = Stream<SeenObjects>;
using MapStream = Stream<LocalMap>;

constexpr const char* kReadFramesDoc =
    R"(The frames of a file, each with the pose at its stamp: [(Frame, Pose), ...].

path: JSON lines (.frames.jsonl) or a recording (.mcap); the first bytes tell which

Of a recording, these are the frames and poses that the service would believe; frames without poses around them are
left out. Frames come in the order of their stamps. What is passed over for another reason is a RuntimeWarning.
FileNotFoundError; RuntimeError: the file cannot be read or is malformed.)";

constexpr const char* kReadObjectsDoc =
    R"(What a tracker followed, each message with the pose at its stamp: [(Objects, Pose), ...].

path: JSON lines (.frames.jsonl) or a recording (.mcap); the first bytes tell which

Of a recording, these are the objects and poses that the service would believe; objects without poses around them are
left out. They come in the order of their stamps. A file without objects gives an empty list. Warnings and errors are
those of read_frames().)";

constexpr const char* kWriteFramesDoc = R"(Writes frames and their poses.

path: a recording where it ends with .mcap, which must not exist yet; else JSON lines (.frames.jsonl), written anew
frames: pairs (Frame, Pose); a pose is taken to be of its frame's stamp. Of a recording, stamps ascend
objects: pairs (Objects, Pose), whose stamps ascend; in JSON lines, each of them has the stamp of a frame

In a recording, sequences are counted up from 1, in session 1, and the poses are those of the frames. Turns are not
written. RuntimeError: the file cannot be written.)";

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
}

/// Converts what was read of a file to a list of pairs.
template <class Seen>
py::list pairs(std::vector<Seen>&& all) {
  py::list out;
  for (auto& [seen, pose] : all) out.append(py::make_tuple(std::move(seen), std::move(pose)));
  return out;
}

VehiclePose pose_of(const Eigen::Isometry3d& T_map_body, std::int64_t stamp_ns) {
  return {.stamp_ns = stamp_ns,
          .position = T_map_body.translation(),
          .orientation = Eigen::Quaterniond(T_map_body.rotation()).normalized()};
}

/// Reads a file to a list of pairs. `for_each` visits what is read, with its pose.
template <class Pair, class ForEach>
py::list read_pairs(const py::object& file, const ForEach& for_each) {
  const std::string name = existing_path(file, "path");
  std::vector<Pair> all;
  evaluation::InputAccount account;
  {
    const py::gil_scoped_release others_run;
    account = for_each(
        name,
        [&](const auto& seen, const Eigen::Isometry3d& T_map_body) {
          all.push_back({seen, pose_of(T_map_body, seen.stamp_ns)});
        },
        evaluation::InputReading{});
  }
  warn_of(name, account);
  return pairs(std::move(all));
}

py::list read_frames(const py::object& file) {
  return read_pairs<SeenFrame>(file, evaluation::for_each_frame);
}

py::list read_objects(const py::object& file) {
  return read_pairs<SeenObjects>(file, evaluation::for_each_objects);
}

py::list read_next_turns(const py::object& file) {
  return read_pairs<SeenTurn>(file, evaluation::for_each_next_turn);
}

void write_recording(const std::string& file, const std::vector<SeenFrame>& seen,
                     const std::vector<SeenObjects>& seen_objects) {
  std::vector<VehiclePose> poses;
  std::vector<DetectionFrame> frames;
  for (const auto& [frame, pose] : seen) {
    if (!frames.empty() && frame.stamp_ns <= frames.back().stamp_ns)
      throw py::value_error(fmt::format("frames[{}]: the stamps must ascend", frames.size()));
    poses.push_back(pose);
    poses.back().stamp_ns = frame.stamp_ns;
    frames.push_back(frame);
  }
  imports::OtherInputs others;
  for (const SeenObjects& each : seen_objects) others.objects.push_back(each.objects);
  imports::write_drive(file, poses, frames, others, /*strict=*/true);
}

void write_json_lines(const std::string& file, const std::vector<SeenFrame>& seen,
                      const std::vector<SeenObjects>& seen_objects) {
  std::map<std::int64_t, const TrackedObjects*> objects;
  for (const SeenObjects& each : seen_objects) objects[each.objects.stamp_ns] = &each.objects;
  io::JsonLinesWriter out(file);
  for (const auto& [frame, pose] : seen) {
    io::FrameRecord record{frame, pose};
    if (const auto found = objects.find(frame.stamp_ns); found != objects.end())
      record.objects = *found->second;
    out.write(record);
  }
  out.close();
}

/// Objects in the order of their stamps; in JSON lines, each of them belongs to a frame.
std::vector<SeenObjects> objects_to_write(const py::object& value, const std::vector<SeenFrame>& frames,
                                          bool of_frames) {
  std::vector<SeenObjects> objects = list(value, "objects", seen_objects);
  std::set<std::int64_t> stamps_ns;
  for (const SeenFrame& seen : frames) stamps_ns.insert(seen.frame.stamp_ns);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::int64_t stamp_ns = objects[i].objects.stamp_ns;
    if (i > 0 && stamp_ns <= objects[i - 1].objects.stamp_ns)
      refuse_value(fmt::format("objects[{}]", i), "the stamps must ascend");
    if (of_frames && !stamps_ns.contains(stamp_ns))
      refuse_value(fmt::format("objects[{}]", i),
                   "no frame has its stamp, as JSON lines need; write a .mcap");
  }
  return objects;
}

void write_frames(const py::object& file, const py::object& frames, const py::object& objects) {
  const std::string name = path(file, "path");
  const bool recorded = name.ends_with(".mcap");
  const std::vector<SeenFrame> seen = list(frames, "frames", seen_frame);
  const std::vector<SeenObjects> others = objects_to_write(objects, seen, !recorded);
  const py::gil_scoped_release others_run;
  if (recorded)
    write_recording(name, seen, others);
  else
    write_json_lines(name, seen, others);
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

py::object to_python(SeenFrame&& seen) { return py::make_tuple(std::move(seen.frame), std::move(seen.pose)); }
py::object to_python(SeenObjects&& seen) {
  return py::make_tuple(std::move(seen.objects), std::move(seen.pose));
}
py::object to_python(LocalMap&& map) { return py::cast(std::move(map)); }

template <class T>
py::object next(Stream<T>& stream) {
  std::optional<T> item;
  {
    const py::gil_scoped_release others_run;
    item = stream.next();
  }
  if (item) return to_python(*std::move(item));
  warn_of(stream.file(), stream.account());
  throw py::stop_iteration();
}

std::unique_ptr<FrameStream> iter_frames(const py::object& file) {
  return std::make_unique<FrameStream>(
      existing_path(file, "path"),
      [](const std::string& name, const auto& put, const evaluation::InputReading& reading) {
        return evaluation::for_each_frame(
            name,
            [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
              put({frame, pose_of(T_map_body, frame.stamp_ns)});
            },
            reading);
      });
}

std::unique_ptr<ObjectsStream> iter_objects(const py::object& file) {
  return std::make_unique<ObjectsStream>(
      existing_path(file, "path"),
      [](const std::string& name, const auto& put, const evaluation::InputReading& reading) {
        return evaluation::for_each_objects(
            name,
            [&](const TrackedObjects& seen, const Eigen::Isometry3d& T_map_body) {
              put({seen, pose_of(T_map_body, seen.stamp_ns)});
            },
            reading);
      });
}

std::unique_ptr<MapStream> iter_maps(const py::object& file) {
  return std::make_unique<MapStream>(
      existing_path(file, "path"),
      [](const std::string& name, const auto& put, const evaluation::InputReading& reading) {
        return evaluation::for_each_map(
            name, [&](const LocalMap& map) { put(map); }, reading);
      });
}

}  // namespace

void bind_files(py::module_& module) {
  using py::arg;
  const auto self = [](const py::object& stream) { return stream; };
  py::class_<FrameStream>(module, "FrameIterator", "The frames of a file, one after the other.")
      .def("__iter__", self)
      .def("__next__", &next<SeenFrame>);
  py::class_<ObjectsStream>(module, "ObjectsIterator", "The objects of a file, one message after the other.")
      .def("__iter__", self)
      .def("__next__", &next<SeenObjects>);
  py::class_<MapStream>(module, "MapIterator", "The maps of a file, one after the other.")
      .def("__iter__", self)
      .def("__next__", &next<LocalMap>);
  module.def("iter_frames", &iter_frames, arg("path"),
             "The same as read_frames(), one after the other: a long file takes little memory.");
  module.def("iter_objects", &iter_objects, arg("path"),
             "The same as read_objects(), one after the other: a long file takes little memory.");
  module.def("iter_maps", &iter_maps, arg("path"),
             "The same as read_maps(), one after the other: a long file takes little memory.");
  module.def("read_frames", &read_frames, arg("path"), kReadFramesDoc);
  module.def("read_objects", &read_objects, arg("path"), kReadObjectsDoc);
  module.def("read_next_turns", &read_next_turns, arg("path"),
             "The turns of a file: [(NextTurn, Pose), ...], read as read_objects() reads objects.");
  module.def("write_frames", &write_frames, arg("path"), arg("frames"), arg("objects") = py::tuple(),
             kWriteFramesDoc);
  module.def("read_maps", &read_maps, arg("path"), kReadMapsDoc);
  module.def("write_maps", &write_maps, arg("path"), arg("maps"),
             "Writes maps as JSON lines (.jsonl). RuntimeError: the file cannot be written.");
}

}  // namespace laneloom::python
