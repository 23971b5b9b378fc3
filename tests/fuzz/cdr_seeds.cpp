#include <cstdio>
#include <exception>
#include <fstream>

#include "io/json_lines.hpp"
#include "laneloom/dds/cdr.hpp"
#include "laneloom/messages.hpp"

namespace {

using namespace laneloom;

/// Writes a seed as the target `cdr` reads it: a byte that tells the type, and the message.
template <class T>
void write(const std::string& file, char type, const T& message) {
  std::vector<std::uint8_t> bytes;
  dds::to_cdr(message, "map", bytes);
  std::ofstream out(file, std::ios::binary);
  out.put(type);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

void write_all(const std::string& folder, const io::FrameRecord& seen, const LocalMap& map) {
  write(folder + "/detections", 0, seen.frame);
  write(folder + "/pose", 1, seen.pose);
  write(folder + "/map", 2, PublishedMap{.frame_id = "map", .fused_frames = {{}}, .map = map});
  write(folder + "/markings", 3, RoadMarkings{.frame_id = "map", .markings = map.boundaries});
  write(folder + "/objects", 4, TrackedObjects{.stamp_ns = 1, .objects = {{.id = 1}}});
  write(folder + "/next_turn", 5, NextTurn{.stamp_ns = 1, .turn = Linkage::Turn::left, .distance_m = 50.0});
  write(folder + "/status", 6,
        ServiceStatus{.counters = {{"ticks", 1}}, .sources = {{.source = "camera"}}, .version = "1"});
}

}  // namespace

/// cdr_seeds FRAMES MAPS FOLDER: a message of each type, of the first frame and map.
int main(int argc, char** argv) try {
  if (argc != 4) throw std::runtime_error("usage: cdr_seeds FRAMES MAPS FOLDER");
  const auto frame = io::JsonLinesReader(argv[1]).next_frame();
  const auto map = io::JsonLinesReader(argv[2]).next_map();
  write_all(argv[3], frame.value(), map.value());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "cdr_seeds: %s\n", error.what());
  return 1;
}
