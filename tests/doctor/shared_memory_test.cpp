#include "scenes.hpp"

namespace laneloom::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(SharedMemory, FilesOfOthersAndOfNobody) {
  Observed seen;
  seen.dds.transport = "udp+shm";
  seen.shared_memory = {{"fastrtps_1", "me", true, false},
                        {"fastrtps_2", "laneloom", false, false},
                        {"fastrtps_3", "me", true, true},
                        {"fastrtps_4", "laneloom", false, true},
                        {"fastrtps_5", "me", true, true}};
  const Findings found = shared_memory_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("shared_memory_of_others", "stale_shared_memory"));
  EXPECT_THAT(found[0].found, HasSubstr(": 1 of laneloom."));
  EXPECT_THAT(found[1].found, HasSubstr(": 1 of laneloom, 2 of me."));
}

TEST(SharedMemory, DoesNotMatterWhereItIsNotUsed) {
  Observed seen;
  seen.shared_memory = {{"fastrtps_2", "laneloom", false, true}};
  EXPECT_THAT(shared_memory_findings(seen), IsEmpty());
  seen.dds.transport = "udp+shm";
  seen.shared_memory = {{"fastrtps_1", "me", true, false}};
  EXPECT_THAT(shared_memory_findings(seen), IsEmpty());
}

}  // namespace
}  // namespace laneloom::doctor
