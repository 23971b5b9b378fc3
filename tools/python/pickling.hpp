#pragma once

#include <pybind11/pybind11.h>

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "base/fields.hpp"
#include "laneloom/objects.hpp"
#include "simulation/road.hpp"

/// Lets objects of the module be pickled, and so copied and sent to other processes.

namespace Eigen {

template <class Archive, class Scalar, int Rows, int Columns>
void serialize(Archive& archive, Matrix<Scalar, Rows, Columns>& matrix) {
  for (Scalar& value : matrix.reshaped()) archive(value);
}

template <class Archive>
void serialize(Archive& archive, Quaterniond& rotation) {
  archive(rotation.coeffs());
}

template <class Archive>
void serialize(Archive& archive, Isometry3d& transform) {
  archive(transform.matrix());
}

}  // namespace Eigen

namespace laneloom {

// A member that is missing in a structured binding, or in a table of fields, is an error of the compiler.

template <class Archive>
void serialize(Archive& archive, LaneChange& change) {
  auto& [from, to, begin, length_m] = change;
  archive(from, to, begin, length_m);
}

template <class Archive, HasFields Struct>
void serialize(Archive& archive, Struct& element) {
  for_each_field<Struct>([&](const auto& field) { archive(element.*field.member); });
  // Those that are not published.
  if constexpr (std::is_same_v<Struct, Border>) archive(element.reversed);
  if constexpr (std::is_same_v<Struct, Way>) archive(element.wish, element.change);
}

template <class Archive>
void serialize(Archive& archive, DetectionFrame& frame) {
  auto& [stamp_ns, sequence, session_id, source, detected_types, field_of_view, occluded_areas, detections] =
      frame;
  archive(stamp_ns, sequence, session_id, source, detected_types, field_of_view, occluded_areas, detections);
}

template <class Archive>
void serialize(Archive& archive, TrackedObjects& objects) {
  auto& [stamp_ns, sequence, session_id, all, in_map_frame] = objects;
  archive(stamp_ns, sequence, session_id, all, in_map_frame);
}

template <class Archive>
void serialize(Archive& archive, NextTurn& turn) {
  auto& [stamp_ns, sequence, session_id, kind, distance_m] = turn;
  archive(stamp_ns, sequence, session_id, kind, distance_m);
}

template <class Archive>
void serialize(Archive& archive, VehiclePose& pose) {
  auto& [stamp_ns, sequence, session_id, position, orientation] = pose;
  archive(stamp_ns, sequence, session_id, position, orientation);
}

template <class Archive>
void serialize(Archive& archive, LocalMap& map) {
  auto& [stamp_ns, T_map_body, markings, boundaries, stoplines, lanes, linkages, way, driven_paths, lineage] =
      map;
  archive(stamp_ns, T_map_body, markings, boundaries, stoplines, lanes, linkages, way, driven_paths, lineage);
}

namespace simulation {

template <class Archive>
void serialize(Archive& archive, RoadMarking& marking) {
  auto& [id, type, style, points] = marking;
  archive(id, type, style, points);
}

template <class Archive>
void serialize(Archive& archive, RoadLane& lane) {
  auto& [id, left, right, centerline, left_marking, right_marking, in_intersection, successors] = lane;
  archive(id, left, right, centerline, left_marking, right_marking, in_intersection, successors);
}

template <class Archive>
void save(Archive& archive, const Road& road) {
  archive(road.name, road.right_hand_traffic, road.markings, road.lanes, road.drive.poses());
}

template <class Archive>
void load(Archive& archive, Road& road) {
  std::vector<VehiclePose> poses;
  archive(road.name, road.right_hand_traffic, road.markings, road.lanes, poses);
  if (!poses.empty()) road.drive = Drive::recorded(std::move(poses));
}

}  // namespace simulation

namespace python {

/// How objects are pickled, as an argument of class_::def(). A pickle is read by the version of laneloom that
/// wrote it.
template <class T>
auto pickled() {
  namespace py = pybind11;
  return py::pickle(
      [](const T& value) {
        std::ostringstream out;
        cereal::BinaryOutputArchive archive(out);
        archive(value);
        return py::make_tuple(LANELOOM_VERSION, py::bytes(std::move(out).str()));
      },
      [](const py::tuple& state) {
        if (state.size() != 2 || std::string(py::str(state[0])) != LANELOOM_VERSION)
          throw py::value_error("the pickle is of another version of laneloom");
        std::istringstream in{std::string(py::bytes(state[1]))};
        T value;
        try {
          cereal::BinaryInputArchive archive(in);
          archive(value);
        } catch (const std::exception&) {
          throw py::value_error("the pickle is damaged");
        }
        return value;
      });
}

}  // namespace python
}  // namespace laneloom
