#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <cstdint>
#include <exception>
#include <span>
#include <vector>

#include "cdr/layout.hpp"

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
}

/// Calls `read(cdr)` behind the encapsulation header, which must be well formed. Throws what Fast CDR throws.
template <class Read>
void read_cdr(std::span<const std::uint8_t> from, Read read) {
  // Fast CDR knows no buffer that is only read.
  auto* bytes = reinterpret_cast<char*>(const_cast<std::uint8_t*>(from.data()));
  eprosima::fastcdr::FastBuffer buffer(bytes, from.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.read_encapsulation();
  read(cdr);
}

/// False when the bytes are no such message; `to` is of no use then.
template <class Message>
bool deserialise(std::span<const std::uint8_t> from, Message& to) {
  if (!well_formed<Message>(from)) return false;
  try {
    read_cdr(from, [&](eprosima::fastcdr::Cdr& cdr) { to.deserialize(cdr); });
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace laneloom::dds
