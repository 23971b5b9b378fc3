#include "binding.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace laneloom::python;
  module.doc() = "The extension that the package laneloom consists of.";
  module.attr("__version__") = LANELOOM_VERSION;
  bind_config(module);
  bind_frame(module);
  bind_map(module);
  bind_graph(module);
  bind_mapper(module);
  bind_truth(module);
  bind_files(module);
  bind_evaluation(module);
  bind_later(module);
  bind_render(module);
}
