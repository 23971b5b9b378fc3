#include <fmt/format.h>

#include <mutex>

#include "arguments.hpp"
#include "binding.hpp"
#include "config/config_file.hpp"
#include "laneloom/mapper.hpp"
#include "why/reason_history.hpp"

namespace laneloom::python {
namespace {

constexpr const char* kDoc = R"(Fuses detections over time into the local lane map.

The same configuration and the same frames give the same maps, to the last bit. Threads may share a mapper: it takes
one frame at a time. Other threads of Python run meanwhile.

config: Config; None: the defaults
explain: whether the mapper keeps its reasons for 10 s, for why())";

constexpr const char* kWhyDoc = R"(Why a line or lane is in the map, or is not: a list of sentences.

id: of a line or lane; one that ended within 10 s is known, too. Empty: nothing of that id was followed
detection: number of a detection of the last frame, instead: taken by which line, or dropped by which rule

ValueError: the mapper was made without explain=True.)";

constexpr const char* kUpdateDoc = R"(Fuses one frame and returns the map after it.

frame: Frame, as the network saw it
pose: Pose of the vehicle at the frame's stamp. Poses of one drive are in one map frame)";

constexpr const char* kAddDoc =
    R"(Takes what a tracker follows, or the next turn of the route. The next update() uses it.

objects: Objects, in the order of their stamps, and of their sessions where stamps are equal; or NextTurn
pose: Pose of the vehicle at its stamp)";

/// A mapper that several threads may use, one at a time.
class SharedMapper {
 public:
  SharedMapper(const MapperConfig& config, bool explain)
      : config_(config), explain_(explain), mapper_(config) {}

  LocalMap update(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
    const std::lock_guard lock(mutex_);
    return mapper_.update(frame, T_map_body, explain_ ? &reasons_ : nullptr);
  }
  template <class T>
  void add(const T& seen, const Eigen::Isometry3d& T_map_body) {
    const std::lock_guard lock(mutex_);
    mapper_.add(seen, T_map_body);
  }
  std::vector<std::string> why(ElementId id) {
    const std::lock_guard lock(mutex_);
    return reasons_.of(id, mapper_.map());
  }
  std::string why_detection(std::size_t number) {
    const std::lock_guard lock(mutex_);
    return reasons_.of_detection(number);
  }
  /// The configuration and the state, for a pickle.
  std::pair<std::string, std::string> saved() {
    const std::lock_guard lock(mutex_);
    return {config::dump(Config{.mapper = config_}), mapper_.save()};
  }
  void load(const std::string& bytes) { mapper_.load(bytes); }
  bool explains() const { return explain_; }
  LocalMap map() {
    const std::lock_guard lock(mutex_);
    return mapper_.map();
  }
  void reset() {
    const std::lock_guard lock(mutex_);
    mapper_.reset();
  }
  std::vector<std::pair<std::string, double>> learned(const std::string& source) {
    const std::lock_guard lock(mutex_);
    return mapper_.learned(source);
  }

 private:
  MapperConfig config_;
  bool explain_;
  std::mutex mutex_;
  why::ReasonHistory reasons_;
  Mapper mapper_;
};

std::unique_ptr<SharedMapper> make_mapper(const py::object& config, const py::object& explain) {
  const Config chosen = config.is_none() ? Config{} : instance<Config>(config, "config");
  config::validate(chosen);
  return std::make_unique<SharedMapper>(chosen.mapper, boolean(explain, "explain"));
}

py::list why(SharedMapper& mapper, const py::object& id, const py::object& detection) {
  if (id.is_none() == detection.is_none())
    throw py::type_error("id, detection: exactly one of the two must be given");
  if (!mapper.explains()) throw py::value_error("explain: the mapper was made without");
  py::list sentences;
  if (id.is_none()) {
    sentences.append(mapper.why_detection(count(detection, "detection")));
    return sentences;
  }
  for (const std::string& sentence : mapper.why(count(id, "id"))) sentences.append(sentence);
  return sentences;
}

py::tuple saved(SharedMapper& mapper) {
  const auto [config, state] = mapper.saved();
  return py::make_tuple(config, py::bytes(state), mapper.explains());
}

std::unique_ptr<SharedMapper> loaded(const py::tuple& state) {
  const Config config = config::parse_config(py::str(state[0]), "the pickle");
  auto mapper = std::make_unique<SharedMapper>(config.mapper, py::cast<bool>(state[2]));
  mapper->load(py::bytes(state[1]));
  return mapper;
}

LocalMap update(SharedMapper& mapper, const py::object& frame, const py::object& pose) {
  const DetectionFrame& seen = instance<DetectionFrame>(frame, "frame");
  const Eigen::Isometry3d T_map_body = transform(instance<VehiclePose>(pose, "pose"));
  const py::gil_scoped_release others_run;
  return mapper.update(seen, T_map_body);
}

void add(SharedMapper& mapper, const py::object& seen, const py::object& pose) {
  const auto add_as = [&]<class T>(const T& message) {
    const Eigen::Isometry3d T_map_body = transform(instance<VehiclePose>(pose, "pose"));
    const py::gil_scoped_release others_run;
    mapper.add(message, T_map_body);
  };
  if (py::isinstance<NextTurn>(seen)) return add_as(seen.cast<const NextTurn&>());
  add_as(instance<TrackedObjects>(seen, "objects"));
}

py::dict learned(SharedMapper& mapper, const py::object& source) {
  py::dict out;
  for (const auto& [what, value] : mapper.learned(text(source, "source"))) out[py::str(what)] = value;
  return out;
}

}  // namespace

void bind_mapper(py::module_& module) {
  using Release = py::call_guard<py::gil_scoped_release>;
  py::class_<SharedMapper>(module, "Mapper", kDoc)
      .def(py::init(&make_mapper), py::arg("config") = py::none(), py::kw_only(), py::arg("explain") = false)
      .def(py::pickle(&saved, &loaded))
      .def("why", &why, py::arg("id") = py::none(), py::kw_only(), py::arg("detection") = py::none(), kWhyDoc)
      .def("update", &update, py::arg("frame"), py::arg("pose"), kUpdateDoc)
      .def("add", &add, py::arg("objects"), py::arg("pose"), kAddDoc)
      .def_property_readonly("map", py::cpp_function(&SharedMapper::map, Release()),
                             "The map after the last update.")
      .def("learned", &learned, py::arg("source"),
           "The values that were learned of a source's network, by name. Empty: the source is unknown.")
      .def("reset", &SharedMapper::reset, Release(),
           "Forgets everything but the ids that were given out and what was learned of the networks.");
}

}  // namespace laneloom::python
