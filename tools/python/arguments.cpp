#include "arguments.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace laneloom::python {
namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::string shape_text(const std::vector<py::ssize_t>& shape) {
  std::string out = "(";
  for (const py::ssize_t size : shape)
    out += (out.size() > 1 ? ", " : "") + (size < 0 ? "N" : std::to_string(size));
  return out + (shape.size() == 1 ? ",)" : ")");
}

/// An array of real numbers. Values that numpy would convert to numbers (bools, texts, complex numbers) are
/// refused.
Array array(const py::handle& value, const std::string& name) {
  const py::array any = py::array::ensure(value);
  if (!any) refuse_type(name, "an array of numbers", value);
  if (any.size() == 0) return Array(any);
  const char kind = any.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') refuse_type(name, "an array of numbers", value);
  Array numbers = Array::ensure(any);
  if (!numbers) refuse_type(name, "an array of numbers", value);
  if (!std::all_of(numbers.data(), numbers.data() + numbers.size(),
                   [](double x) { return std::isfinite(x); }))
    refuse_value(name, "must be finite");
  return numbers;
}

/// An array of a given shape. A size of -1 stands for any size.
Array shaped(const py::handle& value, const std::string& name, const std::vector<py::ssize_t>& shape) {
  Array numbers = array(value, name);
  const std::vector<py::ssize_t> given(numbers.shape(), numbers.shape() + numbers.ndim());
  const auto fits = [](py::ssize_t wanted, py::ssize_t size) { return wanted < 0 || wanted == size; };
  if (!std::equal(shape.begin(), shape.end(), given.begin(), given.end(), fits))
    refuse_value(name, "must have the shape " + shape_text(shape) + ", not " + shape_text(given));
  return numbers;
}

py::int_ whole(const py::handle& value, const std::string& name) {
  if (!PyIndex_Check(value.ptr()) || PyBool_Check(value.ptr()) || py::isinstance<py::array>(value))
    refuse_type(name, "an integer", value);
  PyObject* const number = PyNumber_Index(value.ptr());
  if (number == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::int_>(number);
}

/// Whether Python raised this exception, which is taken back then. Another one is thrown.
bool raised(PyObject* exception) {
  if (PyErr_Occurred() == nullptr) return false;
  if (PyErr_ExceptionMatches(exception) == 0) throw py::error_already_set();
  PyErr_Clear();
  return true;
}

}  // namespace

void refuse_type(const std::string& name, const std::string& expected, const py::handle& value) {
  throw py::type_error(name + ": must be " + expected + ", not " +
                       std::string(py::str(py::type::of(value).attr("__name__"))));
}

void refuse_value(const std::string& name, const std::string& complaint) {
  throw py::value_error(name + ": " + complaint);
}

double number(const py::handle& value, const std::string& name) {
  const bool is_number = PyFloat_Check(value.ptr()) || PyIndex_Check(value.ptr()) ||
                         py::hasattr(value, "__float__");  // numpy's scalars
  if (!is_number || PyBool_Check(value.ptr()) || py::isinstance<py::array>(value))
    refuse_type(name, "a number", value);
  const double number = PyFloat_AsDouble(value.ptr());
  const bool overflows = raised(PyExc_OverflowError);  // an integer
  if (overflows || !std::isfinite(number)) refuse_value(name, "must be finite");
  return number;
}

std::int64_t integer(const py::handle& value, const std::string& name) {
  const long long number = PyLong_AsLongLong(whole(value, name).ptr());
  if (raised(PyExc_OverflowError)) refuse_value(name, "must fit into 64 bits");
  return number;
}

std::uint64_t count(const py::handle& value, const std::string& name) {
  const py::int_ number = whole(value, name);
  if (number < py::int_(0)) refuse_value(name, "must not be negative");
  const unsigned long long count = PyLong_AsUnsignedLongLong(number.ptr());
  if (raised(PyExc_OverflowError)) refuse_value(name, "must fit into 64 bits");
  return count;
}

bool boolean(const py::handle& value, const std::string& name) {
  if (!PyBool_Check(value.ptr())) refuse_type(name, "a bool", value);
  return value.ptr() == Py_True;
}

std::string text(const py::handle& value, const std::string& name) {
  if (!py::isinstance<py::str>(value)) refuse_type(name, "a str", value);
  Py_ssize_t bytes = 0;
  const char* const utf8 = PyUnicode_AsUTF8AndSize(value.ptr(), &bytes);
  if (raised(PyExc_UnicodeError)) refuse_value(name, "must be text that UTF-8 can hold");
  return {utf8, static_cast<std::size_t>(bytes)};
}

std::string path(const py::handle& value, const std::string& name) {
  if (!py::isinstance<py::str>(value) && !py::hasattr(value, "__fspath__"))
    refuse_type(name, "a str or an os.PathLike", value);
  PyObject* bytes = nullptr;
  PyUnicode_FSConverter(value.ptr(), &bytes);
  if (raised(PyExc_ValueError)) refuse_value(name, "cannot be the name of a file");
  return std::string(py::reinterpret_steal<py::bytes>(bytes));
}

Polyline polyline(const py::handle& value, const std::string& name) {
  if (py::isinstance<py::sequence>(value) && py::len(value) == 0) return {};
  const Array numbers = shaped(value, name, {-1, 3});
  Polyline points(static_cast<std::size_t>(numbers.shape(0)));
  const double* next = numbers.data();
  for (Point& point : points) {
    point = Point(next[0], next[1], next[2]);
    next += 3;
  }
  return points;
}

Polyline line(const py::handle& value, const std::string& name) {
  Polyline points = polyline(value, name);
  if (points.size() < 2) refuse_value(name, "must have at least two points");
  return points;
}

std::vector<double> fixed_array(const py::handle& value, const std::string& name,
                                const std::vector<py::ssize_t>& shape) {
  const Array numbers = shaped(value, name, shape);
  return {numbers.data(), numbers.data() + numbers.size()};
}

std::string existing_path(const py::handle& value, const std::string& name) {
  std::string file = path(value, name);
  std::error_code why;
  if (std::filesystem::exists(file, why)) return file;
  errno = why ? why.value() : ENOENT;
  PyErr_SetFromErrnoWithFilename(PyExc_OSError, file.c_str());
  throw py::error_already_set();
}

}  // namespace laneloom::python
