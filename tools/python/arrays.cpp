#include "arrays.hpp"

#include <algorithm>

namespace laneloom::python {

static_assert(sizeof(Point) == 3 * sizeof(double), "a polyline's coordinates lie one behind the other");

namespace {

py::array_t<double> read_only(py::array_t<double> view) {
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

}  // namespace

py::array_t<double> view_of(const Polyline& points, py::handle owner) {
  const double* data = points.empty() ? nullptr : points.front().data();
  return read_only(
      py::array_t<double>({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}}, data, owner));
}

py::array_t<double> view_of(const std::vector<double>& numbers, py::handle owner) {
  return read_only(py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data(), owner));
}

py::array_t<double> to_array(const Polyline& points) {
  py::array_t<double> out({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  if (!points.empty()) std::copy_n(points.front().data(), 3 * points.size(), out.mutable_data());
  return out;
}

py::array_t<double> to_array(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::array_t<double> to_array(const Point& point) { return py::array_t<double>(py::ssize_t{3}, point.data()); }

py::array_t<double> to_array(const Eigen::Quaterniond& orientation) {
  return py::array_t<double>(py::ssize_t{4}, orientation.coeffs().data());
}

py::array_t<double> to_array(const Eigen::Isometry3d& transform) {
  py::array_t<double> out({py::ssize_t{4}, py::ssize_t{4}});
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(out.mutable_data()) = transform.matrix();
  return out;
}

}  // namespace laneloom::python
