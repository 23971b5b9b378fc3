#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

/// The parts of the module, each in a file of its own. Objects of the module cannot be changed once they are
/// made, so that threads may share them. Config and Mapper are exceptions.
namespace laneloom::python {

namespace py = pybind11;

void bind_config(py::module_& module);
void bind_frame(py::module_& module);
void bind_map(py::module_& module);
void bind_way(py::module_& module);
void bind_graph(py::module_& module);
void bind_mapper(py::module_& module);
void bind_truth(py::module_& module);
void bind_files(py::module_& module);
void bind_evaluation(py::module_& module);
void bind_later(py::module_& module);
void bind_render(py::module_& module);

/// A frame and the pose at its stamp.
struct SeenFrame {
  DetectionFrame frame;
  VehiclePose pose;
};

/// Objects and the pose at their stamp.
struct SeenObjects {
  TrackedObjects objects;
  VehiclePose pose;
};

/// Converts a pair (Frame, Pose), as read_frames() gives it.
SeenFrame seen_frame(const py::handle& value, const std::string& name);
/// A turn and the pose at its stamp.
struct SeenTurn {
  NextTurn turn;
  VehiclePose pose;
};

/// Converts a pair (Objects, Pose), as read_objects() gives it.
SeenObjects seen_objects(const py::handle& value, const std::string& name);
/// Converts a list of such pairs, whose stamps must ascend.
std::vector<SeenFrame> frames_in_order(const py::handle& value, const std::string& name);

}  // namespace laneloom::python
