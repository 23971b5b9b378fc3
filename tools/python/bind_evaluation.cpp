#include <fmt/format.h>

#include <limits>

#include "arguments.hpp"
#include "binding.hpp"
#include "evaluation/map_evaluation.hpp"

namespace laneloom::python {
namespace {

constexpr const char* kEvaluateDoc = R"(Rates maps or single detections by the truth of the road.

truth: Truth
maps: LocalMap objects, or
frames: pairs (Frame, Pose); exactly one of the two is given. Stamps ascend
config: Config whose mapper.range is the box around the vehicle that counts; None: the default range
min_confidence: detections below it do not count

The measures are those of `laneloom evaluate --truth`. Other threads of Python run meanwhile.)";

constexpr const char* kScoreDoc =
    R"(Precision, recall and F1 (0..1) of the lines of one kind, over all frames.

A prediction is a true positive if its samples lie less than 0.5 m from a truth line along 75 % of that line's samples.
acd_m is the mean distance of the matched samples in metres.)";

std::vector<LocalMap> given_maps(const py::object& maps) {
  std::vector<LocalMap> out = list(maps, "maps", instance<LocalMap>);
  for (std::size_t i = 1; i < out.size(); ++i)
    if (out[i].stamp_ns < out[i - 1].stamp_ns)
      refuse_value("maps[" + std::to_string(i) + "]", "stamps must ascend");
  return out;
}

evaluation::Measures rate_maps(const simulation::Road& road, const RangeConfig& range,
                               const std::vector<LocalMap>& maps) {
  const py::gil_scoped_release others_run;
  evaluation::MapEvaluation evaluation(road, range, evaluation::Subject::maps);
  for (const LocalMap& map : maps) evaluation.add(map);
  return evaluation.measures();
}

evaluation::Measures rate_frames(const simulation::Road& road, const RangeConfig& range,
                                 const std::vector<SeenFrame>& frames, double min_confidence) {
  const py::gil_scoped_release others_run;
  evaluation::MapEvaluation evaluation(road, range, evaluation::Subject::detections);
  for (const auto& [frame, pose] : frames) evaluation.add(frame, transform(pose), min_confidence);
  return evaluation.measures();
}

evaluation::Measures evaluate(const py::object& truth, const py::object& maps, const py::object& frames,
                              const py::object& config, const py::object& min_confidence) {
  if (maps.is_none() == frames.is_none())
    throw py::type_error("maps, frames: exactly one of the two must be given");
  const simulation::Road& road = instance<simulation::Road>(truth, "truth");
  const RangeConfig range =
      config.is_none() ? RangeConfig{} : RangeConfig(instance<Config>(config, "config").mapper.range);
  const double least = number(min_confidence, "min_confidence");
  if (!maps.is_none()) return rate_maps(road, range, given_maps(maps));
  return rate_frames(road, range, frames_in_order(frames, "frames"), least);
}

/// A method that gives the score of one kind.
auto score_of(evaluation::LineKind kind) {
  return [kind](const evaluation::Measures& measures) { return measures.score.of(kind); };
}

void bind_scores(py::module_& module) {
  py::class_<evaluation::Score>(module, "Score", kScoreDoc)
      .def_property_readonly("precision", &evaluation::Score::precision)
      .def_property_readonly("recall", &evaluation::Score::recall)
      .def_property_readonly("f1", &evaluation::Score::f1)
      .def_property_readonly("acd_m", &evaluation::Score::acd_m)
      .def_readonly("truths", &evaluation::Score::truths)
      .def_readonly("predictions", &evaluation::Score::predictions)
      .def_readonly("matches", &evaluation::Score::matches)
      .def("__repr__", [](const evaluation::Score& s) {
        return fmt::format("<Score precision {:.3f}, recall {:.3f}, f1 {:.3f}, acd {:.3f} m>", s.precision(),
                           s.recall(), s.f1(), s.acd_m());
      });
  py::class_<evaluation::PairScore>(module, "PairScore",
                                    "Precision, recall and F1 (0..1) of what relates two elements.")
      .def_property_readonly("precision", &evaluation::PairScore::precision)
      .def_property_readonly("recall", &evaluation::PairScore::recall)
      .def_property_readonly("f1", &evaluation::PairScore::f1)
      .def_readonly("published", &evaluation::PairScore::published)
      .def_readonly("truths", &evaluation::PairScore::truths);
}

py::dict stability_of(const evaluation::Measures& m) {
  const evaluation::Stability of = m.markings_stability();
  py::dict out;
  out["jitter_mean_m"] = of.jitter_m.mean();
  out["jitter_p95_m"] = of.jitter_m.quantile(0.95);
  out["id_switches_per_km"] = of.id_switches_per_km();
  out["flicker"] = of.flicker();
  return out;
}

py::dict trust_of(const evaluation::Trust& of) {
  py::dict out;
  out["within_2_sigma"] = of.within_2_sigma();
  out["expected_calibration_error"] = of.expected_calibration_error();
  out["first_appearance_p50_s"] = of.first_appearance_s.quantile(0.5);
  out["first_appearance_p50_m"] = of.first_appearance_m.quantile(0.5);
  out["never_appeared"] = of.never_appeared;
  return out;
}

py::dict steadiness_of(const evaluation::Measures& m) {
  const evaluation::Steadiness& of = m.steadiness;
  const auto share = [](std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
  };
  py::dict out;
  out["own_lane"] = share(of.own_lanes, of.own_wanted);
  out["own_id_changes_per_km"] = of.own_changes_per_km();
  out["blinks_per_s"] = of.per_second(of.blinks);
  out["turned_per_s"] = of.per_second(of.turned);
  out["doubted_per_s"] = of.per_second(of.doubted);
  out["right_way"] = share(of.right_ways, of.true_ways);
  out["reach_p5_m"] = of.reach_m.quantile(0.05);
  py::dict jumps;
  for (std::size_t i = 0; i < evaluation::kJumpsAhead_m.size(); ++i)
    jumps[py::float_(evaluation::kJumpsAhead_m[i])] = of.jump_m[i].quantile(0.99);
  out["jump_p99_m"] = jumps;
  return out;
}

py::dict styles_of(const evaluation::Measures& m) {
  py::dict out;
  out["accuracy"] = m.styles.accuracy();
  out["unknown_share"] = m.styles.unknown_share();
  return out;
}

}  // namespace

void bind_evaluation(py::module_& module) {
  using py::arg;
  bind_scores(module);
  py::class_<evaluation::Measures>(module, "Evaluation", "The outcome of evaluate().")
      .def_property_readonly(
          "frames", [](const evaluation::Measures& m) { return m.score.frames; }, "How many were rated.")
      .def_property_readonly(
          "markings", [](const evaluation::Measures& m) { return m.score.markings(); },
          "Of lanelines, roadedges and stoplines together.")
      .def_property_readonly("laneline", score_of(evaluation::LineKind::laneline))
      .def_property_readonly("roadedge", score_of(evaluation::LineKind::roadedge))
      .def_property_readonly("stopline", score_of(evaluation::LineKind::stopline))
      .def_property_readonly("lane", score_of(evaluation::LineKind::lane), "Of the lanes' centerlines.")
      .def_property_readonly(
          "mean_ap", [](const evaluation::Measures& m) { return m.average_precision.map(); },
          "Chamfer mAP at 0.5, 1.0 and 1.5 m, 0..1, of the markings.")
      .def_property_readonly(
          "top_ll", [](const evaluation::Measures& m) { return m.top_ll.value(); },
          "OpenLane-V2's TOP_ll of the linkages, 0..1.")
      .def_property_readonly("stability", &stability_of, "Of the markings, from map to map.")
      .def_property_readonly(
          "trust", [](const evaluation::Measures& m) { return trust_of(m.markings); },
          "How far deviations and probabilities of the markings can be believed.")
      .def_property_readonly("styles", &styles_of, "Solid or dashed.")
      .def_property_readonly("steadiness", &steadiness_of,
                             "What a planner takes from the maps; zeros where detections were rated.")
      .def("__repr__",
           [](const evaluation::Measures& m) {
             return fmt::format("<Evaluation of {} frames: markings F1 {:.3f}, lanes F1 {:.3f}>",
                                m.score.frames, m.score.markings().f1(),
                                m.score.of(evaluation::LineKind::lane).f1());
           })
      .def_property_readonly("linkages", [](const evaluation::Measures& m) { return m.topology.linkages; })
      .def_property_readonly("directions",
                             [](const evaluation::Measures& m) { return m.topology.directions; })
      .def_property_readonly("stopline_lanes",
                             [](const evaluation::Measures& m) { return m.topology.stopline_lanes; });
  module.def("evaluate", &evaluate, arg("truth"), arg("maps") = py::none(), py::kw_only(),
             arg("frames") = py::none(), arg("config") = py::none(),
             arg("min_confidence") = PreprocessConfig{}.min_confidence, kEvaluateDoc);
}

}  // namespace laneloom::python
