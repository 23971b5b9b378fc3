#include "doctor/host.hpp"

#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

namespace laneloom::doctor {
namespace {

// Ports of discovery, by the defaults of the RTPS standard.
constexpr int kFirstPort = 7400;
constexpr int kPortsPerDomain = 250;
constexpr int kFirstUnicast = 10;
constexpr int kDomains = 233;

/// Whether a file has a name that Fast DDS 2 or 3 gives to shared memory.
bool is_shared_memory(std::string_view name) {
  return name.starts_with("fastrtps_") || name.starts_with("fastdds_");
}

namespace fs = std::filesystem;

/// The local port of a line of /proc/net/udp: "  12: 00000000:1CE8 00000000:0000 07 …".
std::optional<int> local_port(const std::string& line) {
  std::istringstream words(line);
  std::string number, address;
  if (!(words >> number >> address)) return std::nullopt;
  const auto colon = address.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  int port = 0;
  const char* end = address.data() + address.size();
  const auto [rest, error] = std::from_chars(address.data() + colon + 1, end, port, 16);
  return error == std::errc() && rest == end ? std::optional(port) : std::nullopt;
}

std::optional<uid_t> owner_of(const fs::path& path) {
  struct stat info = {};
  return stat(path.c_str(), &info) == 0 ? std::optional(info.st_uid) : std::nullopt;
}

std::string name_of(uid_t owner) {
  const passwd* entry = getpwuid(owner);
  return entry ? entry->pw_name : std::to_string(owner);
}

/// The mappings of processes.
struct Mappings {
  std::set<std::string> files;  ///< names of Fast DDS's
  std::set<uid_t> unreadable;   ///< owners of processes whose mappings may not be read
};

void add_mappings(std::istream& maps, Mappings& mappings) {
  for (std::string line; std::getline(maps, line);) {
    const auto slash = line.rfind('/');
    if (slash == std::string::npos) continue;
    const std::string name = line.substr(slash + 1, line.find(' ', slash) - slash - 1);
    if (is_shared_memory(name)) mappings.files.insert(name);
  }
}

bool is_process(const fs::path& path) {
  const std::string name = path.filename();
  return !name.empty() && std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

/// The domains in which a process listens.
std::vector<int> domains_of(const fs::path& process) {
  std::set<std::string> files;  // "socket:[4711]"
  std::error_code ignored;
  for (const auto& file : fs::directory_iterator(process / "fd", ignored))
    files.insert(fs::read_symlink(file.path(), ignored).string());
  std::ifstream all(process / "net" / "udp");
  std::stringstream own;
  for (std::string line; std::getline(all, line);) {
    constexpr int kInodeAt = 9;
    std::istringstream words(line);
    std::string word;
    for (int i = 0; i <= kInodeAt; ++i) words >> word;
    if (files.contains("socket:[" + word + "]")) own << line << '\n';
  }
  return listening_domains(own);
}

Mappings mappings_of(const fs::path& processes) {
  Mappings mappings;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(processes, ignored)) {
    if (!is_process(entry.path())) continue;
    const auto owner = owner_of(entry.path());
    std::ifstream maps(entry.path() / "maps");
    if (maps)
      add_mappings(maps, mappings);
    else if (owner)  // else it has ended meanwhile
      mappings.unreadable.insert(*owner);
  }
  return mappings;
}

}  // namespace

std::vector<int> listening_domains(std::istream& sockets) {
  std::set<int> ports;
  for (std::string line; std::getline(sockets, line);) {
    if (const auto port = local_port(line)) ports.insert(*port);
  }
  std::vector<int> domains;
  for (int domain = 0; domain < kDomains; ++domain) {
    const int multicast = kFirstPort + kPortsPerDomain * domain;
    // Another program may use the multicast port by chance. A participant also has a unicast port.
    const auto unicast = ports.lower_bound(multicast + kFirstUnicast);
    if (ports.contains(multicast) && unicast != ports.end() && *unicast < multicast + kPortsPerDomain)
      domains.push_back(domain);
  }
  return domains;
}

std::vector<ServiceProcess> service_processes(const fs::path& processes, int domain) {
  std::vector<ServiceProcess> result;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(processes, ignored)) {
    if (!is_process(entry.path())) continue;
    std::ifstream stat(entry.path() / "stat");  // "12 (laneloomd) S …"
    ServiceProcess process;
    std::string name;
    char state = 0;
    if (!(stat >> process.id >> name >> state) || name != "(laneloomd)") continue;
    const auto domains = domains_of(entry.path());
    if (std::ranges::find(domains, domain) == domains.end()) continue;
    process.stopped = state == 'T' || state == 't';
    result.push_back(process);
  }
  std::ranges::sort(result, {}, &ServiceProcess::id);
  return result;
}

std::vector<SharedMemoryFile> shared_memory_files(const fs::path& folder, const fs::path& processes) {
  const Mappings mappings = mappings_of(processes);
  std::vector<SharedMemoryFile> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename();
    const auto owner = owner_of(entry.path());
    if (!owner || !is_shared_memory(name) || name.ends_with("_el")) continue;
    const bool ours = *owner == geteuid();
    files.push_back(
        {.name = name,
         .owner = name_of(*owner),
         .ours = ours,
         .stale = !mappings.files.contains(name) && (ours || !mappings.unreadable.contains(*owner))});
  }
  return files;
}

}  // namespace laneloom::doctor
