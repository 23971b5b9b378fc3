#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "check/drives.hpp"
#include "doctor/findings.hpp"

namespace laneloom::doctor {
namespace {

TEST(Fit, ALiveDriveInTheConventionsOfOthersIsFound) {
  Observed seen;
  seen.drive = check::simulated_drive("curve", "none");
  EXPECT_TRUE(fit_findings(seen, MapperConfig{}).empty());
  for (DetectionFrame& frame : seen.drive.frames[""])
    for (Detection& detection : frame.detections)
      for (Point& point : detection.points) point.y() = -point.y();
  const Findings found = fit_findings(seen, MapperConfig{});
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().id, "fit_axes");
  EXPECT_THAT(found.front().remedy, testing::HasSubstr("laneloom check"));
}

TEST(Fit, NothingIsSaidOfTooLittle) {
  Observed seen;
  EXPECT_TRUE(fit_findings(seen, MapperConfig{}).empty()) << "nobody was heard";
  seen.drive = check::simulated_drive("curve", "none");
  seen.drive.frames[""].resize(20);
  EXPECT_TRUE(fit_findings(seen, MapperConfig{}).empty());
}

}  // namespace
}  // namespace laneloom::doctor
