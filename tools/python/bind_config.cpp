#include <pybind11/eval.h>

#include <algorithm>

#include "arguments.hpp"
#include "binding.hpp"
#include "config/config_file.hpp"

namespace laneloom::python {
namespace {

constexpr const char* kDoc = R"(All settings of laneloom, by the keys of its configuration file.

>>> config = Config("av2")
>>> config["mapper.range.side_max_m"] = 20
>>> config["mapper.range.side_max_m"]
20.0

preset: "inhouse" or "av2", the local range and alpha_n of the paper's data sets; None: the defaults

ValueError: the preset is unknown.)";

/// Converts the text of a value in a configuration file.
py::object python_value(const std::string& text) {
  if (text == "true" || text == "false") return py::bool_(text == "true");
  try {
    std::size_t end = 0;
    const double number = std::stod(text, &end);
    if (end != text.size()) return py::str(text);
    const bool whole = text.find_first_not_of("+-0123456789") == std::string::npos;
    return whole ? py::object(py::int_(std::stoll(text))) : py::object(py::float_(number));
  } catch (const std::logic_error&) {  // no number
    return py::str(text);
  }
}

std::string config_text(const py::object& value) {
  if (PyBool_Check(value.ptr())) return value.ptr() == Py_True ? "true" : "false";
  if (py::isinstance<py::str>(value)) return text(value, "value");
  number(value, "value");
  return py::str(value);
}

py::object value_of(const Config& config, const std::string& key) {
  const auto all = config::settings(config);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& setting) { return setting.first == key; });
  if (found == all.end()) throw py::key_error(key);
  return python_value(found->second);
}

py::list keys_of(const Config& config) {
  py::list keys;
  for (const auto& [key, value] : config::settings(config)) keys.append(key);
  return keys;
}

Config make_config(const py::object& preset) {
  Config config;
  if (!preset.is_none()) config::apply_preset(config, text(preset, "preset"));
  return config;
}

void set(Config& config, const py::object& key, const py::object& value) {
  config::set_value(config, text(key, "key") + "=" + config_text(value));
}

}  // namespace

void bind_config(py::module_& module) {
  py::register_exception<ConfigError>(module, "ConfigError", PyExc_ValueError).doc() =
      "A configuration is wrong: \"file:line: key: what\".";
  py::class_<Config>(module, "Config", kDoc)
      .def(py::init(&make_config), py::arg("preset") = py::none())
      .def_static(
          "load", [](const py::object& file) { return config::load_config(existing_path(file, "path")); },
          py::arg("path"),
          "The configuration in a YAML file; a key that is missing keeps its default. ConfigError: the file "
          "is wrong.")
      .def(
          "__getitem__", [](const Config& c, const py::object& key) { return value_of(c, text(key, "key")); },
          py::arg("key"))
      .def("__setitem__", &set, py::arg("key"), py::arg("value"))
      .def(
          "__contains__", [](const Config& c, const py::object& key) { return keys_of(c).contains(key); },
          py::arg("key"))
      .def("__iter__", [](const Config& c) { return py::iter(keys_of(c)); })
      .def("__len__", [](const Config& c) { return keys_of(c).size(); })
      .def("keys", &keys_of, "Every key, in the order of the file.")
      .def(
          "dump", [](const Config& c) { return config::dump(c); },
          "The whole configuration as a YAML file, with units.")
      .def(py::pickle([](const Config& c) { return config::dump(c); },
                      [](const std::string& yaml) { return config::parse_config(yaml, "the pickle"); }))
      .def("__repr__", [](const Config& c) { return "<Config " + config::config_hash(c) + ">"; });
}

}  // namespace laneloom::python
