#include "commands/evaluation_tables.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "evaluation/figure.hpp"
#include "laneloom/element_names.hpp"

namespace laneloom::commands {
namespace {

using evaluation::cell, evaluation::null_or, evaluation::when;

constexpr std::array kKinds{evaluation::LineKind::laneline, evaluation::LineKind::roadedge,
                            evaluation::LineKind::stopline, evaluation::LineKind::lane};

bool has_stability(const evaluation::Stability& stability) { return stability.driven_past_m > 0.0; }

evaluation::Figure switches_per_km(const evaluation::Stability& stability) {
  return when(stability.has_ids, stability.id_switches_per_km());
}

std::string stability_table(const std::vector<NamedEvaluation>& evaluations) {
  std::string table =
      fmt::format("\n{:<10} {:<6} {:>10} {:>10} {:>10} {:>8} {:>8} {:>9} {:>9}\n", "stability", "",
                  "jitter p50", "p95 [m]", "mean", "ids/km", "/100 m", "flicker %", "past [m]");
  for (const evaluation::LineKind kind : kKinds) {
    for (const auto& [who, evaluation] : evaluations) {
      const evaluation::Stability& of = evaluation.stability().of(kind);
      if (!has_stability(of)) continue;
      const bool jitter = of.jitter_m.count() > 0;
      const evaluation::Figure switches = switches_per_km(of);
      table += fmt::format("{:<10} {:<6} {} {} {} {} {} {} {:>9.0f}\n", name(kind), who,
                           cell(when(jitter, of.jitter_m.quantile(0.5)), 4, 10),
                           cell(when(jitter, of.jitter_m.quantile(0.95)), 4, 10),
                           cell(when(jitter, of.jitter_m.mean()), 4, 10), cell(switches, 2, 8),
                           cell(when(switches.has_value(), switches.value_or(0.0) / 10.0), 3, 8),
                           cell(when(of.was_right > 0, 100.0 * of.flicker()), 2, 9), of.driven_past_m);
    }
  }
  return table;
}

nlohmann::json stability_json(const evaluation::Stability& of) {
  const bool jitter = of.jitter_m.count() > 0;
  return {{"jitter_p50_m", null_or(when(jitter, of.jitter_m.quantile(0.5)))},
          {"jitter_p95_m", null_or(when(jitter, of.jitter_m.quantile(0.95)))},
          {"jitter_mean_m", null_or(when(jitter, of.jitter_m.mean()))},
          {"id_switches", of.id_switches},
          {"id_switches_per_km", null_or(switches_per_km(of))},
          {"flicker", null_or(when(of.was_right > 0, of.flicker()))},
          {"driven_past_m", of.driven_past_m}};
}

std::string pair_row(const std::string& what, const std::string& who, const evaluation::PairScore& score,
                     bool with_recall = true) {
  if (score.published == 0 && score.truths == 0) return {};
  const bool recall = with_recall && score.truths > 0;
  return fmt::format("{:<20} {:<6} {} {} {} {:>8} {:>8}\n", what, who,
                     cell(when(score.published > 0, 100 * score.precision()), 2, 7),
                     cell(when(recall, 100 * score.recall()), 2, 7),
                     cell(when(recall, 100 * score.f1()), 2, 7), score.published, score.truths);
}

std::string topology_table(const std::vector<NamedEvaluation>& evaluations) {
  std::string rows;
  for (const auto& [who, evaluation] : evaluations) {
    const evaluation::TopologyScore& topology = evaluation.topology();
    rows += pair_row("linkages", who, topology.linkages);
    for (std::size_t i = 0; i < evaluation::kLinkageKindCount; ++i)
      rows +=
          pair_row(fmt::format("  {}", name(static_cast<Linkage::Kind>(i))), who, topology.by_kind[i], false);
    if (topology.directions.published > 0) rows += pair_row("driving directions", who, topology.directions);
    rows += pair_row("stoplines' lanes", who, topology.stopline_lanes);
    const evaluation::TopLl& top_ll = evaluation.top_ll();
    if (top_ll.vertices > 0)
      rows += fmt::format("{:<20} {:<6} {:>7.2f} %\n", "TOP_ll", who, 100 * top_ll.value());
  }
  if (rows.empty()) return {};
  return fmt::format("\n{:<20} {:<6} {:>7} {:>7} {:>7} {:>8} {:>8}\n", "topology", "", "P [%]", "R [%]",
                     "F1 [%]", "found", "truth") +
         rows;
}

nlohmann::json pair_json(const evaluation::PairScore& score) {
  return {{"precision", null_or(when(score.published > 0, score.precision()))},
          {"recall", null_or(when(score.truths > 0, score.recall()))},
          {"f1", null_or(when(score.published > 0 && score.truths > 0, score.f1()))},
          {"found", score.published},
          {"truth", score.truths}};
}

nlohmann::json topology_json(const evaluation::TopologyScore& topology) {
  nlohmann::json json{{"linkages", pair_json(topology.linkages)},
                      {"directions", pair_json(topology.directions)},
                      {"stopline_lanes", pair_json(topology.stopline_lanes)}};
  for (std::size_t i = 0; i < evaluation::kLinkageKindCount; ++i)
    json["linkage_kinds"][name(static_cast<Linkage::Kind>(i))] = pair_json(topology.by_kind[i]);
  return json;
}

std::string ap_table(const std::vector<NamedEvaluation>& evaluations) {
  std::string table = fmt::format("\n{:<10} {:<6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "AP [%]", "",
                                  "0.5 m", "1.0 m", "1.5 m", "C 0.5 m", "C 1.0 m", "C 1.5 m");
  for (const auto& [who, evaluation] : evaluations) {
    const evaluation::AveragePrecisionMeter& meter = evaluation.average_precision();
    for (const evaluation::LineKind kind : kKinds) {
      if (meter.truths(kind) == 0) continue;
      table += fmt::format("{:<10} {:<6}", name(kind), who);
      for (std::size_t t = 0; t < evaluation::kApThresholds_m.size(); ++t)
        table += " " + cell(100 * meter.ap(kind, t), 2, 8);
      for (std::size_t t = 0; t < evaluation::kApThresholds_m.size(); ++t)
        table += " " + cell(when(meter.has_ids(), 100 * meter.c_ap(kind, t)), 2, 8);
      table += "\n";
    }
    table += fmt::format("{:<10} {:<6} mAP {:.2f}, C-mAP {}\n", "markings", who, 100 * meter.map(),
                         cell(when(meter.has_ids(), 100 * meter.c_map()), 2, 0));
  }
  return table;
}

nlohmann::json ap_json(const evaluation::AveragePrecisionMeter& meter) {
  nlohmann::json json{{"map", meter.map()}, {"c_map", null_or(when(meter.has_ids(), meter.c_map()))}};
  for (const evaluation::LineKind kind : kKinds) {
    if (meter.truths(kind) == 0) continue;
    for (std::size_t t = 0; t < evaluation::kApThresholds_m.size(); ++t) {
      const std::string threshold = fmt::format("{:.1f}", evaluation::kApThresholds_m[t]);
      json[name(kind)]["ap"][threshold] = meter.ap(kind, t);
      json[name(kind)]["c_ap"][threshold] = null_or(when(meter.has_ids(), meter.c_ap(kind, t)));
    }
  }
  return json;
}

std::string trust_row(const std::string& what, const std::string& who, const evaluation::Trust& trust) {
  const Distribution& after_s = trust.first_appearance_s;
  const Distribution& after_m = trust.first_appearance_m;
  if (after_s.count() + trust.never_appeared == 0) return {};
  return fmt::format("{:<10} {:<6} {} {} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>7}\n", what, who,
                     cell(when(trust.vertices > 0, 100 * trust.within_2_sigma()), 1, 9),
                     cell(when(trust.has_confidences(), trust.expected_calibration_error()), 3, 7),
                     after_s.quantile(0.5), after_s.quantile(0.95), after_m.quantile(0.5),
                     after_m.quantile(0.95), trust.never_appeared);
}

std::string trust_table(const std::vector<NamedEvaluation>& evaluations) {
  std::string table = fmt::format("\n{:<10} {:<6} {:>9} {:>7} {:>9} {:>9} {:>9} {:>9} {:>7}\n", "trust", "",
                                  "2 sigma %", "ECE", "first p50", "p95 [s]", "p50", "p95 [m]", "never");
  for (const auto& [who, evaluation] : evaluations) {
    table += trust_row("markings", who, evaluation.trust().markings());
    table += trust_row("lane", who, evaluation.trust().lanes());
  }
  return table;
}

nlohmann::json trust_json(const evaluation::Trust& trust) {
  nlohmann::json bins = nlohmann::json::array();
  for (const evaluation::CalibrationBin& bin : trust.calibration)
    bins.push_back({{"count", bin.count}, {"confidence", bin.confidence()}, {"precision", bin.precision()}});
  return {{"within_2_sigma", null_or(when(trust.vertices > 0, trust.within_2_sigma()))},
          {"vertices", trust.vertices},
          {"calibration", std::move(bins)},
          {"expected_calibration_error",
           null_or(when(trust.has_confidences(), trust.expected_calibration_error()))},
          {"first_appearance_p50_s", trust.first_appearance_s.quantile(0.5)},
          {"first_appearance_p95_s", trust.first_appearance_s.quantile(0.95)},
          {"first_appearance_p50_m", trust.first_appearance_m.quantile(0.5)},
          {"first_appearance_p95_m", trust.first_appearance_m.quantile(0.95)},
          {"appeared", trust.first_appearance_s.count()},
          {"never_appeared", trust.never_appeared}};
}

std::string style_lines(const std::vector<NamedEvaluation>& evaluations) {
  std::string lines;
  for (const auto& [who, evaluation] : evaluations) {
    const evaluation::StyleScore& styles = evaluation.styles();
    lines +=
        fmt::format("{:<10} {:<6} accuracy {}, unknown {:.2f} %\n", "style", who,
                    styles.right + styles.wrong > 0 ? fmt::format("{:.2f} %", 100 * styles.accuracy()) : "-",
                    100 * styles.unknown_share());
  }
  return "\n" + lines;
}

nlohmann::json style_json(const evaluation::StyleScore& styles) {
  return {{"accuracy", null_or(when(styles.right + styles.wrong > 0, styles.accuracy()))},
          {"unknown", styles.unknown_share()}};
}

}  // namespace

std::string evaluation_tables(const std::vector<NamedEvaluation>& evaluations) {
  std::string tables = stability_table(evaluations) + topology_table(evaluations) + style_lines(evaluations) +
                       trust_table(evaluations) + ap_table(evaluations);
  for (const auto& [who, evaluation] : evaluations)
    tables += lane_metres_table(evaluation.lane_metres()) + steadiness_table(evaluation.steadiness());
  return tables;
}

nlohmann::json evaluation_json(const std::vector<NamedEvaluation>& evaluations) {
  nlohmann::json json;
  for (const auto& [who, evaluation] : evaluations) {
    for (const evaluation::LineKind kind : kKinds)
      json[who]["stability"][name(kind)] = stability_json(evaluation.stability().of(kind));
    json[who]["topology"] = topology_json(evaluation.topology());
    json[who]["topology"]["top_ll"] =
        null_or(when(evaluation.top_ll().vertices > 0, evaluation.top_ll().value()));
    json[who]["style"] = style_json(evaluation.styles());
    json[who]["trust"] = {{"markings", trust_json(evaluation.trust().markings())},
                          {"lane", trust_json(evaluation.trust().lanes())}};
    json[who]["average_precision"] = ap_json(evaluation.average_precision());
    const evaluation::Steadiness steadiness = evaluation.steadiness();
    if (steadiness.maps > 0) json[who]["planner"] = steadiness_json(steadiness);
    if (evaluation.lane_metres().published_m() > 0.0)
      json[who]["lane_metres"] = lane_metres_json(evaluation.lane_metres());
  }
  return json;
}

}  // namespace laneloom::commands
