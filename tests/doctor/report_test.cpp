#include "doctor/report.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "scenes.hpp"

namespace laneloom::doctor {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(DoctorReport, ListsWhatWasFound) {
  Observed seen = healthy();
  seen.participants = {{"01", "\x1b[2J", "10.0.0.1"}, {"02", "", ""}};
  const Findings found{{"a", "It is so.", "It hurts.", "Mend it."}, {"b", "That too.", "Also.", "As well."}};
  const std::string text = report(seen, found);
  EXPECT_THAT(text, HasSubstr("Domain 3, vehicle \"ego\", watched for 3.0 s: 2 participants: "
                              "\"?[2J\" (10.0.0.1), 02."));
  EXPECT_THAT(text, HasSubstr("1. It is so.\n   Why it matters: It hurts.\n   What to do: Mend it.\n"));
  EXPECT_THAT(text, HasSubstr("2. That too."));
  EXPECT_THAT(text, Not(HasSubstr("Nothing wrong")));
  EXPECT_THAT(report(seen, {}), HasSubstr("Nothing wrong was found."));

  const nlohmann::json json = report_json(seen, found);
  EXPECT_EQ(json.at("domain"), 3);
  EXPECT_EQ(json.at("participants").size(), 2U);
  EXPECT_EQ(json.at("findings").at(1).at("id"), "b");
  EXPECT_EQ(json.at("findings").at(0).at("remedy"), "Mend it.");
}

}  // namespace
}  // namespace laneloom::doctor
