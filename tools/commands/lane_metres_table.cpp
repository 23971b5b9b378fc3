#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "commands/evaluation_tables.hpp"
#include "evaluation/figure.hpp"

namespace laneloom::commands {
namespace {

using evaluation::cell, evaluation::null_or, evaluation::share;
using evaluation::LaneClass, evaluation::LaneMetres;

struct NamedClass {
  LaneClass lane_class;
  const char* name;  ///< of the value in JSON
  const char* title;
};
constexpr std::array kLaneClasses{
    NamedClass{LaneClass::right, "right", "right"},
    NamedClass{LaneClass::offset, "offset", "in a lane, beside its middle"},
    NamedClass{LaneClass::straddling, "straddling", "across a line"},
    NamedClass{LaneClass::beside_edge, "beside_edge", "beyond an edge, or a strip beside it"},
    NamedClass{LaneClass::elsewhere, "elsewhere", "elsewhere"}};
static_assert(kLaneClasses.size() == evaluation::kLaneClassCount);

std::string percent_row(const char* what, double part_m, double whole_m) {
  return fmt::format("{:<46} {}\n", what, cell(share(part_m, whole_m), 1, 0, 100.0));
}

}  // namespace

std::string lane_metres_table(const LaneMetres& metres) {
  const double published_m = metres.published_m();
  if (published_m == 0.0) return {};
  std::string table = fmt::format("\nMetres of lanes, % of {:.0f} m in all maps\n", published_m);
  for (const NamedClass& one : kLaneClasses)
    table += percent_row(one.title, metres.of(one.lane_class), published_m);
  const double right_m = metres.of(LaneClass::right);
  table += percent_row("directions, of right metres: told", metres.told_m, right_m) +
           percent_row("  told rightly, of those told", metres.told_right_m, metres.told_m);
  if (metres.shoulder_m > 0.0)
    table += fmt::format("Shoulders, % of {:.0f} m\n", metres.shoulder_m) +
             percent_row("in no lane", metres.shoulder_outside_m, metres.shoulder_m);
  if (metres.driven_m == 0.0) return table;
  return table + fmt::format("Driven paths, % of {:.0f} m\n", metres.driven_m) +
         percent_row("less than 0.9 m from the middle of a lane", metres.driven_near_m, metres.driven_m) +
         percent_row("less than 1.5 m", metres.driven_there_m, metres.driven_m) +
         percent_row("  by their probabilities", metres.driven_belief_m, metres.driven_m);
}

nlohmann::json lane_metres_json(const LaneMetres& metres) {
  const double published_m = metres.published_m(), right_m = metres.of(LaneClass::right);
  nlohmann::json json{{"published_m", published_m},
                      {"directions",
                       {{"precision", null_or(share(metres.told_right_m, metres.told_m))},
                        {"recall", null_or(share(metres.told_right_m, right_m))}}}};
  if (metres.shoulder_m > 0.0)
    json["shoulders"] = {{"metres", metres.shoulder_m},
                         {"outside_lanes", null_or(share(metres.shoulder_outside_m, metres.shoulder_m))}};
  if (metres.driven_m > 0.0)
    json["driven_paths"] = {{"metres", metres.driven_m},
                            {"near", null_or(share(metres.driven_near_m, metres.driven_m))},
                            {"there", null_or(share(metres.driven_there_m, metres.driven_m))},
                            {"probability", null_or(share(metres.driven_belief_m, metres.driven_m))}};
  for (const NamedClass& one : kLaneClasses)
    json[one.name] = null_or(share(metres.of(one.lane_class), published_m));
  return json;
}

}  // namespace laneloom::commands
