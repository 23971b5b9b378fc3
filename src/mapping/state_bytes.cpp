#include "mapping/state_bytes.hpp"

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/deque.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "base/fields.hpp"

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

// A member that is missing in a structured binding, or in a table of fields, is an error of the compiler.

template <class Archive, HasFields Struct>
void serialize(Archive& archive, Struct& element) {
  for_each_field<Struct>([&](const auto& field) { archive(element.*field.member); });
  if constexpr (std::is_same_v<Struct, Border>) archive(element.reversed);
}

template <class Archive>
void serialize(Archive& archive, LocalMap& map) {
  auto& [stamp_ns, T_map_body, markings, boundaries, stoplines, lanes, linkages, way, driven_paths, lineage] =
      map;
  archive(stamp_ns, T_map_body, markings, boundaries, stoplines, lanes, linkages, way, driven_paths, lineage);
}

namespace {

constexpr std::uint64_t kMagic = 0x49'4d4f4f'4c4e414cULL;  // names the format and its version

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
