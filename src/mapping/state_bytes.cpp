#include "mapping/state_bytes.hpp"

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/deque.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace Eigen {

template <class Archive, class Scalar, int Rows, int Columns>
void serialize(Archive& archive, Matrix<Scalar, Rows, Columns>& matrix) {
  for (Scalar& value : matrix.reshaped()) archive(value);
}

template <class Archive>
void serialize(Archive& archive, Isometry3d& transform) {
  archive(transform.matrix());
}

}  // namespace Eigen

namespace laneloom {

// The structured bindings make a member that is forgotten here an error of the compiler.

template <class Archive>
void serialize(Archive& archive, Stretch& range) {
  auto& [from_m, to_m] = range;
  archive(from_m, to_m);
}

template <class Archive>
void serialize(Archive& archive, StyleRange& style_range) {
  auto& [range, style] = style_range;
  archive(range, style);
}

template <class Archive>
void serialize(Archive& archive, LineageEvent& event) {
  auto& [kind, id, other] = event;
  archive(kind, id, other);
}

template <class Archive>
void serialize(Archive& archive, Marking& marking) {
  auto& [id, type, status, points, styles, lateral_stddev_m, existence_probability, observations,
         first_seen_ns, last_seen_ns] = marking;
  archive(id, type, status, points, styles, lateral_stddev_m, existence_probability, observations,
          first_seen_ns, last_seen_ns);
}

template <class Archive>
void serialize(Archive& archive, Neighbour& neighbour) {
  auto& [lane, range, crossable] = neighbour;
  archive(lane, range, crossable);
}

template <class Archive>
void serialize(Archive& archive, Lane& lane) {
  auto& [id, left_boundary, right_boundary, left_range, right_range, left_reversed, right_reversed, left,
         right, centerline, width_m, left_neighbours, right_neighbours, direction, section, status,
         existence_probability, inferred_ranges] = lane;
  archive(id, left_boundary, right_boundary, left_range, right_range, left_reversed, right_reversed, left,
          right, centerline, width_m, left_neighbours, right_neighbours, direction, section, status,
          existence_probability, inferred_ranges);
}

template <class Archive>
void serialize(Archive& archive, Stopline& stopline) {
  auto& [marking, lanes, heading] = stopline;
  archive(marking, lanes, heading);
}

template <class Archive>
void serialize(Archive& archive, Linkage& linkage) {
  auto& [from, to, kind, turn, confidence, path] = linkage;
  archive(from, to, kind, turn, confidence, path);
}

template <class Archive>
void serialize(Archive& archive, LocalMap& map) {
  auto& [stamp_ns, T_map_body, markings, boundaries, stoplines, lanes, linkages, lineage] = map;
  archive(stamp_ns, T_map_body, markings, boundaries, stoplines, lanes, linkages, lineage);
}

namespace {

constexpr std::uint64_t kMagic = 0x36'4d4f4f'4c4e414cULL;  // names the format and its version

}  // namespace

std::string to_bytes(const MapperState& state) {
  std::ostringstream out;
  cereal::PortableBinaryOutputArchive archive(out);
  archive(kMagic, state);
  return std::move(out).str();
}

MapperState from_bytes(const std::string& bytes, const MapperConfig& config) {
  std::istringstream in(bytes);
  cereal::PortableBinaryInputArchive archive(in);
  std::uint64_t magic = 0;
  archive(magic);
  if (magic != kMagic) throw std::runtime_error("not the state of a mapper of this version of laneloom");
  MapperState state(config);
  archive(state);
  return state;
}

}  // namespace laneloom
