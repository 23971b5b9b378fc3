#include "service/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/sinks/systemd_sink.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <utility>

namespace laneloom::service {
namespace {

/// Whether standard error is the journal. systemd names the stream that it connected, so that a stream which
/// was redirected later is told apart.
bool writes_to_journal() {
  const char* stream = std::getenv("JOURNAL_STREAM");
  struct stat errors {};
  return stream != nullptr && fstat(STDERR_FILENO, &errors) == 0 &&
         std::to_string(errors.st_dev) + ":" + std::to_string(errors.st_ino) == stream;
}

std::shared_ptr<spdlog::sinks::sink> make_sink() {
  if (writes_to_journal()) return std::make_shared<spdlog::sinks::systemd_sink_mt>();
  return std::make_shared<spdlog::sinks::stderr_sink_mt>();
}

}  // namespace

void set_up_log(const std::string& level) {
  auto log = std::make_shared<spdlog::logger>("laneloomd", make_sink());
  // The journal adds times of its own, and does not use this pattern.
  log->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  spdlog::set_default_logger(std::move(log));
  set_log_level(level);
}

void print_error(const std::string& text) {
  const char* priority = writes_to_journal() ? SD_ERR : "";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::fprintf(stderr, "%slaneloomd: %s\n", priority, line.c_str());
  }
}

void set_log_level(const std::string& level) { spdlog::set_level(spdlog::level::from_str(level)); }

}  // namespace laneloom::service
