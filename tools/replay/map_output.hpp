#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "laneloom/messages.hpp"
#include "recording/recording.hpp"

namespace laneloom::replay {

/// A digest of 128 bits (XXH3), as 32 hexadecimal digits.
class Digest {
 public:
  Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;
  ~Digest();

  void add(const std::vector<std::uint8_t>& bytes);
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The output of a replay's maps. Not thread-safe.
class MapOutput {
 public:
  virtual ~MapOutput() = default;
  /// Both throw std::runtime_error naming the file when it cannot be written.
  virtual void write(const PublishedMap& map, std::int64_t log_time_ns) = 0;
  virtual void close() = 0;
};

/// Creates a recording with these options if `path` ends with ".mcap", or else JSON lines.
std::unique_ptr<MapOutput> create_map_output(const std::string& path,
                                             const recording::RecordingOptions& options);

/// The message on the topic road_markings that belongs to a map.
RoadMarkings road_markings(const PublishedMap& map);

}  // namespace laneloom::replay
