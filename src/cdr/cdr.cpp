#include "laneloom/dds/cdr.hpp"

#include <utility>

#include "cdr/convert.hpp"
#include "cdr/message_of.hpp"
#include "cdr/serialise.hpp"

namespace laneloom::dds {

template <class T>
std::size_t to_cdr(const T& from, const std::string& map_frame_id, std::vector<std::uint8_t>& to) {
  MessageOf<T> message;
  const std::size_t left_out = to_msg(from, map_frame_id, message);
  serialise(message, to);
  return left_out;
}

template <class T>
std::string_view from_cdr(std::span<const std::uint8_t> from, const std::string& map_frame_id, T& to) {
  MessageOf<T> message;
  const auto why = deserialise(from, message);
  return why.empty() ? from_msg(std::move(message), map_frame_id, to) : why;
}

std::optional<CdrHeader> header_of(std::span<const std::uint8_t> message) {
  // The header's numbers are the first of every message.
  CdrScanner scanner(message);
  scanner.numbers(sizeof(std::uint64_t));
  scanner.numbers(sizeof(std::uint32_t));
  scanner.numbers(sizeof(std::int64_t), 3);
  if (!scanner.ok()) return std::nullopt;
  CdrHeader header;
  read_cdr(message, [&](eprosima::fastcdr::Cdr& cdr) {
    std::uint64_t crc = 0;
    std::uint32_t data_id = 0;
    cdr >> crc >> data_id >> header.stamp_ns >> header.sequence >> header.session_id;
  });
  return header;
}

std::string frame_of_pose(std::span<const std::uint8_t> pose) {
  MessageOf<VehiclePose> message;
  return deserialise(pose, message).empty() ? message.header().frame_id().to_string() : std::string();
}

template std::size_t to_cdr(const DetectionFrame&, const std::string&, std::vector<std::uint8_t>&);
template std::string_view from_cdr(std::span<const std::uint8_t>, const std::string&, DetectionFrame&);
template std::size_t to_cdr(const VehiclePose&, const std::string&, std::vector<std::uint8_t>&);
template std::string_view from_cdr(std::span<const std::uint8_t>, const std::string&, VehiclePose&);
template std::size_t to_cdr(const TrackedObjects&, const std::string&, std::vector<std::uint8_t>&);
template std::string_view from_cdr(std::span<const std::uint8_t>, const std::string&, TrackedObjects&);
template std::size_t to_cdr(const NextTurn&, const std::string&, std::vector<std::uint8_t>&);
template std::string_view from_cdr(std::span<const std::uint8_t>, const std::string&, NextTurn&);
template std::size_t to_cdr(const PublishedMap&, const std::string&, std::vector<std::uint8_t>&);
template std::string_view from_cdr(std::span<const std::uint8_t>, const std::string&, PublishedMap&);
template std::size_t to_cdr(const RoadMarkings&, const std::string&, std::vector<std::uint8_t>&);
template std::string_view from_cdr(std::span<const std::uint8_t>, const std::string&, RoadMarkings&);
template std::size_t to_cdr(const ServiceStatus&, const std::string&, std::vector<std::uint8_t>&);
template std::string_view from_cdr(std::span<const std::uint8_t>, const std::string&, ServiceStatus&);

}  // namespace laneloom::dds
