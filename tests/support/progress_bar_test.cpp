#include "support/progress_bar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace laneloom::support {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ProgressBar, TellsShareRateAndTimeLeft) {
  const std::string line = text({.share = 0.25, .steps = 500, .elapsed_s = 50.0});
  EXPECT_THAT(line, HasSubstr("[##########..............................]  25 %"));
  EXPECT_THAT(line, HasSubstr("10/s"));
  EXPECT_THAT(line, HasSubstr("2:30 left"));
}

TEST(ProgressBar, OfAPipeTellsOnlyWhatIsDone) {
  const std::string line = text({.share = 0.0, .steps = 40, .elapsed_s = 2.0});
  EXPECT_EQ(line, "40 done, 20/s");
}

TEST(ProgressBar, IsWithinItsWidthAtEitherEnd) {
  EXPECT_THAT(text({.share = 1.5, .steps = 1, .elapsed_s = 1.0}), HasSubstr("] 100 %  1/s  0:00 left"));
  EXPECT_THAT(text({.share = 1e-300, .steps = 1, .elapsed_s = 1.0}), Not(HasSubstr("#")));
  EXPECT_THAT(text({.share = 0.5, .steps = 0, .elapsed_s = 0.0}), HasSubstr("50 %  0/s  0:00 left"));
}

}  // namespace
}  // namespace laneloom::support
