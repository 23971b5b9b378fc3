#pragma once

#include <cstdint>
#include <exception>
#include <span>
#include <string_view>
#include <vector>

#include "cdr/fast_cdr.hpp"
#include "cdr/layout.hpp"
#include "cdr/protection.hpp"

namespace laneloom::dds {

/// Writes a generated message as it goes over the wire: XCDR1, lowest byte first.
template <class Message>
void write_cdr(const Message& from, std::vector<std::uint8_t>& to) {
  constexpr std::size_t kEncapsulationBytes = 4;
  to.resize(kEncapsulationBytes + bytes_to_write(from));
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(to.data()), to.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                             eprosima::fastcdr::CdrVersion::XCDRv1);
  cdr.serialize_encapsulation();
  cdr << from;
  to.resize(written_bytes(cdr));
}

template <class Message>
void serialise(const Message& from, std::vector<std::uint8_t>& to) {
  write_cdr(from, to);
  protect(to, kDataId<Message>);
}

/// Calls `read(cdr)` behind the encapsulation header, which must be well formed. Throws the exceptions of
/// Fast CDR.
template <class Read>
void read_cdr(std::span<const std::uint8_t> from, Read read) {
  // Fast CDR has no buffer type for reading alone.
  auto* bytes = reinterpret_cast<char*>(const_cast<std::uint8_t*>(from.data()));
  eprosima::fastcdr::FastBuffer buffer(bytes, from.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                             eprosima::fastcdr::CdrVersion::XCDRv1);
  cdr.read_encapsulation();
  read(cdr);
}

/// Reads a message. Returns why the bytes are no such message: "crc", "data_id" or "malformed"; `to` is not
/// valid then. Empty: `to` is set.
template <class Message>
std::string_view deserialise(std::span<const std::uint8_t> from, Message& to) {
  if (const auto why = check_protection(from, kDataId<Message>); !why.empty()) return why;
  if (!well_formed<Message>(from)) return "malformed";
  try {
    read_cdr(from, [&](eprosima::fastcdr::Cdr& cdr) { cdr >> to; });
    return {};
  } catch (const std::exception&) {
    return "malformed";
  }
}

}  // namespace laneloom::dds
