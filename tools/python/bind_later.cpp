#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "arguments.hpp"
#include "binding.hpp"
#include "evaluation/later.hpp"
#include "laneloom/config.hpp"
#include "laneloom/element_names.hpp"

namespace laneloom::python {
namespace {

constexpr const char* kEvaluateDoc =
    R"(Rates single detections and maps without truth: by what the vehicle sees later from close by.

frames: pairs (Frame, Pose), with the stamps ascending
maps: LocalMap objects, each made after the frame of its stamp; a map of another stamp is left out
min_confidence: detections below it do not count

The measures are those of `laneloom evaluate --later`. Other threads of Python run meanwhile.
RuntimeError: the drive is too short to be rated, or shows too little.)";

constexpr const char* kFiguresDoc =
    R"(Of single detections or of maps, at one distance ahead; None where nothing can be told.

precision: of the lines, the share that was seen later
recall: of the lines that were seen later, the share that was found
lateral_rms_m, lateral_p95_m: lateral errors of the lines that both single detections and maps found, in metres)";

constexpr const char* kScoreDoc = R"(Lines of one type at one distance ahead.

seen_later: how many lines were seen later from close by
single, map: LaterFigures of single detections and of maps)";

constexpr const char* kFiguresByPlaceDoc = R"(The LaterScore of the lines of one type at one distance ahead.

type: "laneline" or "roadedge"
distance_m: 12, 20 or 28)";

/// A getter of a value, which is None in Python if it is missing.
template <std::optional<double> evaluation::LaterScore::Figures::*member>
py::object figure(const evaluation::LaterScore::Figures& figures) {
  const std::optional<double>& value = figures.*member;
  return value ? py::object(py::float_(*value)) : py::object(py::none());
}

double per_frame(std::size_t count, const evaluation::LaterMeter& meter) {
  return static_cast<double>(count) / static_cast<double>(meter.frames());
}

evaluation::LaterScore score_of(const evaluation::LaterMeter& meter, const py::object& type,
                                const py::object& distance_m) {
  const auto kind = word<MarkingType>(type, "type", kTypeNames);
  if (kind == MarkingType::stopline) refuse_value("type", "must be laneline or roadedge, not 'stopline'");
  const auto found = std::ranges::find(evaluation::kLaterDistances_m, number(distance_m, "distance_m"));
  if (found == evaluation::kLaterDistances_m.end()) refuse_value("distance_m", "must be 12, 20 or 28");
  return meter.score(kind, static_cast<std::size_t>(found - evaluation::kLaterDistances_m.begin()));
}

evaluation::LaterMeter rate(const std::vector<SeenFrame>& frames, const std::vector<LocalMap>& maps,
                            double least) {
  std::map<std::int64_t, const LocalMap*> by_stamp;
  for (const LocalMap& map : maps) by_stamp[map.stamp_ns] = &map;
  evaluation::LaterMeter meter(least);
  for (const auto& [frame, pose] : frames)
    if (const auto map = by_stamp.find(frame.stamp_ns); map != by_stamp.end())
      meter.add(frame, transform(pose), *map->second);
  require_rated(meter, "frames, maps");
  return meter;
}

evaluation::LaterMeter evaluate_later(const py::object& frames, const py::object& maps,
                                      const py::object& min_confidence) {
  const std::vector<SeenFrame> seen = frames_in_order(frames, "frames");
  const std::vector<LocalMap> made = list(maps, "maps", instance<LocalMap>);
  const double least = number(min_confidence, "min_confidence");
  const py::gil_scoped_release others_run;
  return rate(seen, made, least);
}

void bind_score(py::module_& module) {
  using Figures = evaluation::LaterScore::Figures;
  py::class_<Figures>(module, "LaterFigures", kFiguresDoc)
      .def_property_readonly("precision", &figure<&Figures::precision>)
      .def_property_readonly("recall", &figure<&Figures::recall>)
      .def_property_readonly("lateral_rms_m", &figure<&Figures::rms_m>)
      .def_property_readonly("lateral_p95_m", &figure<&Figures::p95_m>);
  py::class_<evaluation::LaterScore>(module, "LaterScore", kScoreDoc)
      .def_readonly("seen_later", &evaluation::LaterScore::seen_later)
      .def_property_readonly("single", [](const evaluation::LaterScore& s) { return s.figures(s.single); })
      .def_property_readonly("map", [](const evaluation::LaterScore& s) { return s.figures(s.map); });
}

}  // namespace

void bind_later(py::module_& module) {
  using py::arg;
  bind_score(module);
  py::class_<evaluation::LaterMeter>(module, "LaterEvaluation", "The outcome of evaluate_later().")
      .def_property_readonly("frames", &evaluation::LaterMeter::frames, "How many were rated.")
      .def_property_readonly("driven_m", &evaluation::LaterMeter::driven_m,
                             "Metres between the frames that were rated.")
      .def_property_readonly(
          "lanes_per_frame", [](const evaluation::LaterMeter& m) { return per_frame(m.lanes(), m); },
          "Mean number of lanes in a map.")
      .def_property_readonly(
          "own_lane_share", [](const evaluation::LaterMeter& m) { return per_frame(m.own_lane().frames, m); },
          "Share of the frames (0..1) in whose map the vehicle is in a lane.")
      .def_property_readonly(
          "own_lane_id_changes", [](const evaluation::LaterMeter& m) { return m.own_lane().id_changes; },
          "How often that lane had another id than before.")
      .def("score", &score_of, arg("type"), arg("distance_m"), kFiguresByPlaceDoc);
  module.def("evaluate_later", &evaluate_later, arg("frames"), arg("maps"), py::kw_only(),
             arg("min_confidence") = PreprocessConfig{}.min_confidence, kEvaluateDoc);
}

}  // namespace laneloom::python
