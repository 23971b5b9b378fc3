#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <cstdint>
#include <exception>
#include <span>
#include <string_view>
#include <vector>

#include "cdr/layout.hpp"
#include "cdr/protection.hpp"

namespace laneloom::dds {

template <class Message>
void serialise(const Message& from, std::vector<std::uint8_t>& to) {
  constexpr std::size_t kEncapsulationBytes = 4;
  to.resize(kEncapsulationBytes + Message::getCdrSerializedSize(from));
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(to.data()), to.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                             eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  from.serialize(cdr);
  to.resize(cdr.getSerializedDataLength());
  protect(to, kDataId<Message>);
}

/// Calls `read(cdr)` behind the encapsulation header, which must be well formed. Throws the exceptions of
/// Fast CDR.
template <class Read>
void read_cdr(std::span<const std::uint8_t> from, Read read) {
  // Fast CDR has no buffer type for reading alone.
  auto* bytes = reinterpret_cast<char*>(const_cast<std::uint8_t*>(from.data()));
  eprosima::fastcdr::FastBuffer buffer(bytes, from.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR);
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
    read_cdr(from, [&](eprosima::fastcdr::Cdr& cdr) { to.deserialize(cdr); });
    return {};
  } catch (const std::exception&) {
    return "malformed";
  }
}

}  // namespace laneloom::dds
