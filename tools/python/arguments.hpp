#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "laneloom/types.hpp"

/// Converts arguments that Python passes. A wrong argument raises a TypeError or a ValueError whose text
/// begins with the argument's name. All need the GIL.
namespace laneloom::python {

namespace py = pybind11;

[[noreturn]] void refuse_type(const std::string& name, const std::string& expected, const py::handle& value);
[[noreturn]] void refuse_value(const std::string& name, const std::string& complaint);

double number(const py::handle& value, const std::string& name);              ///< finite
std::int64_t integer(const py::handle& value, const std::string& name);       ///< no float, no bool
std::uint64_t count(const py::handle& value, const std::string& name);        ///< not negative
bool boolean(const py::handle& value, const std::string& name);               ///< exactly True or False
std::string text(const py::handle& value, const std::string& name);           ///< a str, as UTF-8
std::string path(const py::handle& value, const std::string& name);           ///< a str or an os.PathLike
std::string existing_path(const py::handle& value, const std::string& name);  ///< else an OSError
Polyline polyline(const py::handle& value, const std::string& name);  ///< (N, 3), or nothing: an empty list
Polyline line(const py::handle& value, const std::string& name);      ///< (N, 3) of at least two points

/// An array of numbers of exactly this shape.
std::vector<double> fixed_array(const py::handle& value, const std::string& name,
                                const std::vector<py::ssize_t>& shape);

/// An object of a class of the module.
template <class T>
const T& instance(const py::handle& value, std::string_view name) {
  if (!py::isinstance<T>(value))
    refuse_type(std::string(name), std::string(py::str(py::type::of<T>().attr("__name__"))), value);
  return py::cast<const T&>(value);
}

/// The items of a sequence or another iterable, each read by `read(item, "name[i]")`.
template <class Read>
auto list(const py::handle& value, const std::string& name, Read read) {
  if (py::isinstance<py::str>(value) || !py::isinstance<py::iterable>(value))
    refuse_type(name, "a list", value);
  std::vector<std::decay_t<decltype(read(value, name))>> items;
  for (const py::handle item : value)
    items.push_back(read(item, name + "[" + std::to_string(items.size()) + "]"));
  return items;
}

/// The enumerator of a word. `names` has the words in the order of the enumerators.
template <class Enum, std::size_t N>
Enum word(const py::handle& value, const std::string& name, const std::array<const char*, N>& names) {
  const std::string given = text(value, name);
  std::string known;
  for (std::size_t i = 0; i < N; ++i) {
    if (given == names[i]) return static_cast<Enum>(i);
    known += (i == 0 ? "" : ", ") + std::string(names[i]);
  }
  refuse_value(name, "must be one of " + known + ", not '" + given + "'");
}

}  // namespace laneloom::python
