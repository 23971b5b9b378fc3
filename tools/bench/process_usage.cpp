#include "bench/process_usage.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace laneloom::bench {
namespace {

std::string folder(pid_t process) { return "/proc/" + std::to_string(process); }

/// The value of a line "key:  value kB".
double status_mb(pid_t process, const std::string& key) {
  const std::string file = folder(process) + "/status";
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key + ":")) return std::stod(line.substr(key.size() + 1)) / 1024.0;
  throw std::runtime_error(file + ": has no " + key);
}

/// Nanoseconds on a processor, the first number of schedstat.
double thread_cpu_s(const std::filesystem::path& thread) {
  double cpu_ns = 0.0;
  std::ifstream(thread / "schedstat") >> cpu_ns;
  return cpu_ns * 1e-9;
}

}  // namespace

double peak_rss_mb(pid_t process) { return status_mb(process, "VmHWM"); }
double rss_mb(pid_t process) { return status_mb(process, "VmRSS"); }

double cpu_s(pid_t process) {
  double sum_s = 0.0;
  std::error_code error;
  for (const auto& thread : std::filesystem::directory_iterator(folder(process) + "/task", error))
    sum_s += thread_cpu_s(thread.path());
  if (error) throw std::runtime_error(folder(process) + ": " + error.message());
  return sum_s;
}

}  // namespace laneloom::bench
