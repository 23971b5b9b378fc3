#include "snapshot/snapshot.hpp"

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/deque.hpp>
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

template <class Archive>
void serialize(Archive& archive, Range& range) {
  archive(range.from_m, range.to_m);
}

template <class Archive>
void serialize(Archive& archive, StyleRange& style) {
  archive(style.range, style.style);
}

template <class Archive>
void serialize(Archive& archive, LineageEvent& event) {
  archive(event.kind, event.id, event.other);
}

template <class Archive>
void serialize(Archive& archive, Marking& m) {
  archive(m.id, m.type, m.status, m.points, m.styles, m.lateral_stddev_m, m.existence_probability,
          m.observations, m.first_seen_ns);
}

template <class Archive>
void serialize(Archive& archive, Lane& lane) {
  archive(lane.id, lane.left_boundary, lane.right_boundary, lane.left_range, lane.right_range, lane.left,
          lane.right, lane.centerline, lane.width_m, lane.left_neighbour, lane.right_neighbour,
          lane.direction, lane.section, lane.status, lane.existence_probability, lane.inferred_ranges);
}

template <class Archive>
void serialize(Archive& archive, Stopline& stopline) {
  archive(stopline.marking, stopline.lanes, stopline.heading);
}

template <class Archive>
void serialize(Archive& archive, Linkage& linkage) {
  archive(linkage.from, linkage.to, linkage.kind, linkage.turn, linkage.confidence, linkage.path);
}

template <class Archive>
void serialize(Archive& archive, LocalMap& map) {
  archive(map.stamp_ns, map.T_map_body, map.instances, map.boundaries, map.stoplines, map.lanes, map.linkages,
          map.lineage);
}

namespace {

constexpr std::uint64_t kMagic = 0x31'4d4f4f'4c4e414cULL;  // names the format and its version

}  // namespace

std::string to_bytes(const MapperState& state) {
  std::ostringstream out;
  cereal::PortableBinaryOutputArchive archive(out);
  archive(kMagic, state);
  return std::move(out).str();
}

MapperState from_bytes(const std::string& bytes, const VoxelMapConfig& config) {
  std::istringstream in(bytes);
  cereal::PortableBinaryInputArchive archive(in);
  std::uint64_t magic = 0;
  archive(magic);
  if (magic != kMagic) throw std::runtime_error("not a snapshot of this version of laneloom");
  MapperState state(config);
  archive(state);
  return state;
}

}  // namespace laneloom
