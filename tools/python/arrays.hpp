#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <vector>

#include "laneloom/types.hpp"

/// Shows values as numpy's arrays and Python's tuples. Those of to_array() are copies. Views show the memory
/// of an object that cannot change, and keep the object; they are read-only. All need the GIL.
namespace laneloom::python {

namespace py = pybind11;

py::array_t<double> to_array(const Polyline& points);                 ///< (N, 3)
py::array_t<double> to_array(const std::vector<double>& numbers);     ///< (N,)
py::array_t<double> to_array(const Point& point);                     ///< (3,)
py::array_t<double> to_array(const Eigen::Quaterniond& orientation);  ///< (4,): x, y, z, w
py::array_t<double> to_array(const Eigen::Isometry3d& transform);     ///< (4, 4)

py::array_t<double> view_of(const Polyline& points, py::handle owner);              ///< (N, 3)
py::array_t<double> view_of(const std::vector<double>& numbers, py::handle owner);  ///< (N,)

/// The getter of a member that shows it as a view.
template <class Owner, class Member>
auto viewed(Member Owner::*member) {
  return [member](const py::object& self) { return view_of(self.cast<const Owner&>().*member, self); };
}

/// The getter of a member that shows it as a tuple of its items, which keep their owner.
template <class Owner, class Item>
auto items_of(std::vector<Item> Owner::*member) {
  return [member](const py::object& self) {
    const std::vector<Item>& items = self.cast<const Owner&>().*member;
    py::tuple out(items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
      out[i] = py::cast(items[i], py::return_value_policy::reference_internal, self);
    return out;
  };
}

/// A tuple with one array or object per item. A tuple can not be changed unnoticed.
template <class T, class Convert>
py::tuple to_tuple(const std::vector<T>& items, Convert convert) {
  py::tuple out(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) out[i] = convert(items[i]);
  return out;
}

template <class T>
py::tuple to_tuple(const std::vector<T>& items) {
  return to_tuple(items, [](const T& item) { return py::cast(item); });
}

}  // namespace laneloom::python
