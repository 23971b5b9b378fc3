#include "doctor/host.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "temporary_folder.hpp"

namespace laneloom::doctor {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<int> domains(const std::string& lines) {
  std::istringstream in("  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt\n" +
                        lines);
  return listening_domains(in);
}

TEST(Host, DomainsShowByTheirPorts) {
  // 7400 = 1CE8, 7410 = 1CF2; domain 4: 8400 = 20D0, 8413 = 20DD.
  EXPECT_THAT(domains("  10: 00000000:1CE8 00000000:0000 07\n  11: 00000000:1CF2 00000000:0000 07\n"
                      "  12: 0100007F:20DD 00000000:0000 07\n  13: 00000000:20D0 00000000:0000 07\n"),
              ElementsAre(0, 4));
}

TEST(Host, APortAloneIsNoDomain) {
  EXPECT_THAT(domains("  10: 00000000:1CE8 00000000:0000 07\n"), IsEmpty());
  EXPECT_THAT(domains("  10: 00000000:1CF2 00000000:0000 07\n"), IsEmpty());
  // 7400 and 7650: the multicast ports of two domains.
  EXPECT_THAT(domains("  10: 00000000:1CE8 00000000:0000 07\n  11: 00000000:1DE2 00000000:0000 07\n"),
              IsEmpty());
}

TEST(Host, OtherLinesAreNone) {
  EXPECT_THAT(domains("nonsense\n 1: x:y\n 2: 00000000:\n 3: 0:1CE8Z\n\n"), IsEmpty());
}

TEST(Host, ProcessesOfTheServiceInADomain) {
  const TemporaryFolder temporary;
  const std::filesystem::path proc = temporary.path();
  const auto process = [&](const std::string& id, const char* stat, const char* multicast) {
    std::filesystem::create_directories(proc / id / "fd");
    std::filesystem::create_directories(proc / id / "net");
    std::ofstream(proc / id / "stat") << stat;
    std::filesystem::create_symlink(std::string("socket:[") + multicast + "]", proc / id / "fd" / "4");
    std::filesystem::create_symlink("socket:[52]", proc / id / "fd" / "5");
    std::ofstream(proc / id / "net" / "udp") << "  sl\n 1: 0:1CE8 0:0 07 0:0 00:0 0 0 0 51 2\n"
                                                " 2: 0:1CF2 0:0 07 0:0 00:0 0 0 0 52 2\n"
                                                " 3: 0:1DE2 0:0 07 0:0 00:0 0 0 0 53 2\n";
  };
  process("12", "12 (laneloomd) S 1 12 12", "51");
  process("13", "13 (laneloomd) T 1 13 13", "51");
  process("14", "14 (laneloom) T 1 14 14", "51");
  process("15", "15 (laneloomd) S 1 15 15", "53");
  process("16", "", "51");
  const auto found = service_processes(proc, 0);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].id, 12);
  EXPECT_FALSE(found[0].stopped);
  EXPECT_EQ(found[1].id, 13);
  EXPECT_TRUE(found[1].stopped);
  EXPECT_THAT(service_processes(proc, 1), IsEmpty());
}

TEST(Host, SharedMemoryThatNobodyHasMapped) {
  const TemporaryFolder temporary;
  const std::filesystem::path shm = temporary.file("shm"), proc = temporary.file("proc");
  std::filesystem::create_directories(shm);
  std::filesystem::create_directories(proc / "12");
  std::filesystem::create_directories(proc / "sys");
  for (const char* name :
       {"fastdds_bb", "fastdds_bb_el", "fastdds_port7411", "fastrtps_aa", "fastrtps_aa_el",
        "fastrtps_port7411", "sem.fastdds_port7411_mutex", "sem.fastrtps_port7411_mutex", "other"})
    std::ofstream(shm / name) << "x";
  std::ofstream(proc / "12" / "maps") << "7f00-7f01 rw-s 00000000 00:1a 22 /dev/shm/fastrtps_aa\n"
                                         "7f04-7f05 rw-s 00000000 00:1a 24 /dev/shm/fastdds_bb\n"
                                         "7f02-7f03 r-xp 00000000 00:1a 23 /usr/lib/libfastrtps.so\n";
  auto files = shared_memory_files(shm, proc);
  std::ranges::sort(files, {}, &SharedMemoryFile::name);
  ASSERT_EQ(files.size(), 4U);
  const std::vector<std::string> names{"fastdds_bb", "fastdds_port7411", "fastrtps_aa", "fastrtps_port7411"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(files[i].name, names[i]);
    EXPECT_TRUE(files[i].ours);
    EXPECT_EQ(files[i].stale, i % 2 == 1);
    EXPECT_FALSE(files[i].owner.empty());
  }

  EXPECT_THAT(shared_memory_files(temporary.file("missing"), proc), IsEmpty());
}

TEST(Host, SharedMemoryOfAUserWhoseMappingsAreHidden) {
  constexpr uid_t kNobody = 65534;
  const TemporaryFolder temporary;
  const std::filesystem::path shm = temporary.file("shm"), proc = temporary.file("proc");
  std::filesystem::create_directories(shm);
  std::filesystem::create_directories(proc);
  std::ofstream(shm / "fastrtps_bb") << "x";
  if (chown((shm / "fastrtps_bb").c_str(), kNobody, kNobody) != 0) GTEST_SKIP() << "needs root";
  auto files = shared_memory_files(shm, proc);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_FALSE(files[0].ours);
  EXPECT_TRUE(files[0].stale);

  std::filesystem::create_directories(proc / "13");  // without the file `maps`
  ASSERT_EQ(chown((proc / "13").c_str(), kNobody, kNobody), 0);
  EXPECT_FALSE(shared_memory_files(shm, proc)[0].stale);
}

}  // namespace
}  // namespace laneloom::doctor
