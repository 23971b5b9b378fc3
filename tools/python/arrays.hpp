#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <vector>

#include "laneloom/types.hpp"

/// Converts values to numpy's arrays and Python's tuples, which are copies. All need the GIL.
namespace laneloom::python {

namespace py = pybind11;

py::array_t<double> to_array(const Polyline& points);                 ///< (N, 3)
py::array_t<double> to_array(const std::vector<double>& numbers);     ///< (N,)
py::array_t<double> to_array(const Point& point);                     ///< (3,)
py::array_t<double> to_array(const Eigen::Quaterniond& orientation);  ///< (4,): x, y, z, w
py::array_t<double> to_array(const Eigen::Isometry3d& transform);     ///< (4, 4)

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
