#include <fmt/format.h>

#include <mutex>

#include "arguments.hpp"
#include "binding.hpp"
#include "config/config_file.hpp"
#include "laneloom/mapper.hpp"

namespace laneloom::python {
namespace {

constexpr const char* kDoc = R"(Fuses detections over time into the local lane map.

The same configuration and the same frames give the same maps, to the last bit. Threads may share a mapper: it takes
one frame at a time. Other threads of Python run meanwhile.

config: Config; None: the defaults)";

constexpr const char* kUpdateDoc = R"(Fuses one frame and returns the map after it.

frame: Frame, as the network saw it
pose: Pose of the vehicle at the frame's stamp. Poses of one drive are in one map frame)";

/// A mapper that several threads may use, one at a time.
class SharedMapper {
 public:
  explicit SharedMapper(const MapperConfig& config) : mapper_(config) {}

  LocalMap update(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
    const std::lock_guard lock(mutex_);
    return mapper_.update(frame, T_map_body);
  }
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
  std::mutex mutex_;
  Mapper mapper_;
};

std::unique_ptr<SharedMapper> make_mapper(const py::object& config) {
  const Config chosen = config.is_none() ? Config{} : instance<Config>(config, "config");
  config::validate(chosen);
  return std::make_unique<SharedMapper>(chosen.mapper);
}

LocalMap update(SharedMapper& mapper, const py::object& frame, const py::object& pose) {
  const DetectionFrame& seen = instance<DetectionFrame>(frame, "frame");
  const Eigen::Isometry3d T_map_body = transform(instance<VehiclePose>(pose, "pose"));
  const py::gil_scoped_release others_run;
  return mapper.update(seen, T_map_body);
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
      .def(py::init(&make_mapper), py::arg("config") = py::none())
      .def("update", &update, py::arg("frame"), py::arg("pose"), kUpdateDoc)
      .def_property_readonly("map", py::cpp_function(&SharedMapper::map, Release()),
                             "The map after the last update.")
      .def("learned", &learned, py::arg("source"),
           "The values that were learned of a source's network, by name. Empty: the source is unknown.")
      .def("reset", &SharedMapper::reset, Release(),
           "Forgets everything but the ids that were given out and what was learned of the networks.");
}

}  // namespace laneloom::python
