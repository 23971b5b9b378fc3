#include <algorithm>

#include "arguments.hpp"
#include "binding.hpp"
#include "drawing/frame_elements.hpp"
#include "drawing/map_elements.hpp"
#include "drawing/truth.hpp"
#include "laneloom/config.hpp"
#include "render/figure.hpp"

namespace laneloom::python {
namespace {

constexpr const char* kDoc = R"(Draws one moment as seen from above, the vehicle's forward direction up.

path: picture to write (.png or .svg); None: an array (height, width, 3) of bytes is returned
frame: a pair (Frame, Pose), drawn in a panel of its own
map: LocalMap, likewise
truth: Truth, likewise, and beneath the other two
config: Config whose mapper.range is the box that is shown; None: the default range
title: text above the picture

The picture is about the map's pose; without a map, about the frame's. RuntimeError: it cannot be written.)";

/// The things to draw; null: not given.
struct Inputs {
  const LocalMap* map = nullptr;
  const simulation::Road* truth = nullptr;
  std::optional<SeenFrame> seen;
};

render::Moment draw_moment(const Inputs& inputs, const RangeConfig& range) {
  render::Moment moment;
  moment.T_map_body = inputs.map != nullptr ? inputs.map->T_map_body : transform(inputs.seen->pose);
  drawing::Drawing around;
  add_range(range, moment.T_map_body, around);
  add_vehicle(moment.T_map_body, around);
  drawing::Drawing over_truth = around;
  if (inputs.truth != nullptr) add_truth(*inputs.truth, over_truth);
  if (inputs.seen)
    add_detections(inputs.seen->frame, transform(inputs.seen->pose),
                   moment.panels.emplace_back(render::Panel{"Detections (one frame)", over_truth}).drawing);
  if (inputs.map != nullptr)
    add_map(*inputs.map, moment.panels.emplace_back(render::Panel{"Fused map", over_truth}).drawing);
  if (inputs.truth != nullptr)
    add_map(drawing::map_of(*inputs.truth, moment.T_map_body),
            moment.panels.emplace_back(render::Panel{"Ground truth", around}).drawing);
  return moment;
}

/// An array (height, width, 3) of a picture.
py::array_t<std::uint8_t> to_array(const render::Image& image) {
  py::array_t<std::uint8_t> array({image.height, image.width, std::size_t{3}});
  std::ranges::copy(image.rgb, array.mutable_data());
  return array;
}

py::object render(const py::object& file, const py::object& map, const py::object& frame,
                  const py::object& truth, const py::object& config, const py::object& title) {
  if (map.is_none() && frame.is_none()) throw py::type_error("map, frame: one of the two must be given");
  Inputs inputs;
  if (!map.is_none()) inputs.map = &instance<LocalMap>(map, "map");
  if (!truth.is_none()) inputs.truth = &instance<simulation::Road>(truth, "truth");
  if (!frame.is_none()) inputs.seen = seen_frame(frame, "frame");
  render::Figure figure{.title = text(title, "title")};
  if (!config.is_none()) figure.range = instance<Config>(config, "config").mapper.range;
  const std::string name = file.is_none() ? "" : path(file, "path");
  if (!name.empty() && !name.ends_with(".png") && !name.ends_with(".svg"))
    refuse_value("path", "pictures are .png or .svg");
  render::Image image;
  {
    const py::gil_scoped_release others_run;
    figure.moments.push_back(draw_moment(inputs, figure.range));
    if (name.empty())
      image = draw_image(figure);
    else
      draw_figure(figure, name);
  }
  return name.empty() ? py::object(to_array(image)) : py::none();
}

std::string svg_of(const LocalMap& map) {
  render::Figure figure;
  figure.title = "LocalMap at " + std::to_string(map.stamp_ns) + " ns";
  figure.moments.push_back(draw_moment({.map = &map}, figure.range));
  return draw_svg(figure);
}

}  // namespace

void bind_render(py::module_& module) {
  using py::arg;
  // What notebooks show of a map.
  py::class_<LocalMap>(module.attr("LocalMap")).def("_repr_svg_", &svg_of);
  module.def("render", &render, arg("path"), arg("map") = py::none(), py::kw_only(),
             arg("frame") = py::none(), arg("truth") = py::none(), arg("config") = py::none(),
             arg("title") = "laneloom", kDoc);
}

}  // namespace laneloom::python
