#include "support/publication_log.hpp"

#include <stdexcept>

#include "io/csv.hpp"

namespace laneloom::support {
namespace {

constexpr const char* kColumns = "session_id,sequence,published_ns";

}  // namespace

PublicationLogWriter::PublicationLogWriter(const std::filesystem::path& path, std::uint64_t session_id)
    : path_(path), session_id_(session_id), out_(path) {
  out_ << kColumns << std::endl;
  if (!out_) throw std::runtime_error(path.string() + ": cannot be written");
}

void PublicationLogWriter::add(std::uint64_t sequence, std::int64_t published_ns) {
  out_ << session_id_ << ',' << sequence << ',' << published_ns << std::endl;
}

void PublicationLogWriter::close() {
  out_.close();
  if (!out_) throw std::runtime_error(path_.string() + ": writing failed");
}

PublicationLog read_publication_log(const std::filesystem::path& path) {
  PublicationLog log;
  io::for_each_csv_row(path, kColumns, [&](std::string_view row) {
    log.session_id = io::take_number<std::uint64_t>(row);
    const auto sequence = io::take_number<std::uint64_t>(row);
    log.times_ns[sequence] = io::take_number<std::int64_t>(row);
  });
  return log;
}

}  // namespace laneloom::support
