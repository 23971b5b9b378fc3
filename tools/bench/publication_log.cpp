#include "bench/publication_log.hpp"

#include <stdexcept>

#include "io/csv.hpp"

namespace laneloom {

PublicationLogWriter::PublicationLogWriter(const std::filesystem::path& path) : path_(path), out_(path) {
  out_ << "sequence,published_ns\n";
  if (!out_) throw std::runtime_error(path.string() + ": cannot be written");
}

void PublicationLogWriter::add(std::uint64_t sequence, std::int64_t published_ns) {
  out_ << sequence << ',' << published_ns << '\n';
}

void PublicationLogWriter::close() {
  out_.close();
  if (!out_) throw std::runtime_error(path_.string() + ": writing failed");
}

std::map<std::uint64_t, std::int64_t> read_publication_log(const std::filesystem::path& path) {
  std::map<std::uint64_t, std::int64_t> times;
  for_each_csv_row(path, [&](std::string_view row) {
    const auto sequence = take_number<std::uint64_t>(row);
    times[sequence] = take_number<std::int64_t>(row);
  });
  return times;
}

}  // namespace laneloom
