#include "snapshot/snapshot_file.hpp"

#include <unistd.h>
#include <xxhash.h>

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/string.hpp>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "base/seconds.hpp"
#include "laneloom/error.hpp"
#include "mapping/state_bytes.hpp"
#include "snapshot/private_file.hpp"

namespace laneloom::snapshot {

template <class Archive>
void serialize(Archive& archive, SnapshotStamp& stamp) {
  archive(stamp.maker, stamp.steady_ns, stamp.system_ns);
}

namespace {

constexpr int kMostAttempts = 3;
constexpr std::size_t kDigestBytes = sizeof(XXH64_canonical_t);
constexpr std::size_t kBeginning = kDigestBytes + 1 + sizeof(std::uint64_t);

std::string digest(std::string_view bytes) {
  XXH64_canonical_t canonical;
  XXH64_canonicalFromHash(&canonical, XXH3_64bits(bytes.data(), bytes.size()));
  return {reinterpret_cast<const char*>(canonical.digest), kDigestBytes};
}

/// Whether bytes begin as a snapshot of any version: with a digest, the archive's byte order, and the length
/// of the maker's name, which is short. A file that is shorter, or of zeros, may have lost its bytes with the
/// power: that must not keep the service from starting.
bool begins_as_snapshot(std::string_view bytes) {
  constexpr std::string_view kByteOrder("\1", 1), kLengthAbove255("\0\0\0\0\0\0\0", 7);
  const bool is_lost = bytes.size() < kBeginning || bytes.find_first_not_of('\0') == std::string_view::npos;
  return is_lost || (bytes.substr(kDigestBytes, 1) == kByteOrder &&
                     bytes.substr(kDigestBytes + 2, 7) == kLengthAbove255);
}

/// Throws ConfigError if a file is there that is no snapshot.
void refuse_another(const std::string& file) {
  const auto refuse = [&](const std::string& what) {
    throw ConfigError("service.snapshot_file: " + file + " is " + what + ": it would be moved away");
  };
  std::error_code unknown;
  const auto type = std::filesystem::symlink_status(file, unknown).type();
  if (type == std::filesystem::file_type::not_found) return;
  if (type != std::filesystem::file_type::regular) refuse("no regular file");
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse("a file that cannot be read");
  std::string beginning(kBeginning, '\0');
  in.read(beginning.data(), kBeginning);
  beginning.resize(static_cast<std::size_t>(in.gcount()));
  if (!begins_as_snapshot(beginning)) refuse("no snapshot");
}

/// The name of a snapshot that was taken so often.
std::string taken(const std::string& file, int times) {
  return times == 0 ? file : file + "." + std::to_string(times);
}

/// Throws ConfigError if a file that is no snapshot has a name that a snapshot gets.
void refuse_others(const std::string& file) {
  for (int times = 0; times <= kMostAttempts; ++times) refuse_another(taken(file, times));
  refuse_another(file + kUnfinished);
}

void check(const SnapshotStamp& stamp, const SnapshotStamp& now, double max_age_s) {
  if (stamp.maker != now.maker) throw std::runtime_error("made by " + stamp.maker + ", not by " + now.maker);
  for (const std::int64_t age_ns : {now.steady_ns - stamp.steady_ns, now.system_ns - stamp.system_ns}) {
    const double age_s = seconds(age_ns);
    if (age_s < 0.0 || age_s > max_age_s) throw std::runtime_error(std::to_string(age_s) + " s old");
  }
}

}  // namespace

void write_snapshot(const std::string& file, const Snapshot& snapshot) {
  std::ostringstream body;
  cereal::PortableBinaryOutputArchive archive(body);
  archive(snapshot.stamp, snapshot.map_id, snapshot.checkpoint, to_bytes(snapshot.state));
  const std::string bytes = std::move(body).str();
  replace_private_file(file, digest(bytes) + bytes);
}

void check_snapshot_file(const std::string& file) {
  refuse_others(file);
  const auto folder = std::filesystem::absolute(file).parent_path();
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw ConfigError("service.snapshot_file: in the folder " + folder.string() +
                      " no file can be made: " + std::generic_category().message(errno));
}

std::string take_snapshot(const std::string& file) {
  refuse_others(file);
  std::string result;
  for (int times = 0; times < kMostAttempts; ++times) {
    const std::string next = taken(file, times + 1);
    if (result.empty() && std::rename(taken(file, times).c_str(), next.c_str()) == 0)
      result = next;
    else if (!result.empty())
      std::remove(next.c_str());  // of an older one
  }
  return result;
}

Snapshot read_snapshot(const std::string& file, const SnapshotStamp& now, double max_age_s,
                       const MapperConfig& config) {
  const std::string bytes = read_private_file(file);
  // The digest is checked first: lengths within damaged bytes cannot be believed.
  if (bytes.size() < kDigestBytes || digest(std::string_view(bytes).substr(kDigestBytes)) !=
                                         std::string_view(bytes).substr(0, kDigestBytes)) {
    throw std::runtime_error("damaged");
  }
  std::istringstream body(bytes.substr(kDigestBytes));
  cereal::PortableBinaryInputArchive archive(body);
  Snapshot snapshot{{}, 0, {}, MapperState(config)};
  archive(snapshot.stamp);
  check(snapshot.stamp, now, max_age_s);  // first: the rest may not be readable if another version wrote it
  std::string state;
  archive(snapshot.map_id, snapshot.checkpoint, state);
  snapshot.state = from_bytes(state, config);
  return snapshot;
}

}  // namespace laneloom::snapshot
