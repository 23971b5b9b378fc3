#include "snapshot/snapshot_file.hpp"

#include <xxhash.h>

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/string.hpp>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "base/seconds.hpp"
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

std::string digest(std::string_view bytes) {
  XXH64_canonical_t canonical;
  XXH64_canonicalFromHash(&canonical, XXH3_64bits(bytes.data(), bytes.size()));
  return {reinterpret_cast<const char*>(canonical.digest), kDigestBytes};
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

std::string take_snapshot(const std::string& file) {
  const auto taken = [&](int times) { return times == 0 ? file : file + "." + std::to_string(times); };
  std::string result;
  for (int times = 0; times < kMostAttempts; ++times) {
    const std::string next = taken(times + 1);
    if (result.empty() && std::rename(taken(times).c_str(), next.c_str()) == 0)
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
