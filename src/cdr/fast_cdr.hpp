#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <cstddef>

#if __has_include(<fastcdr/CdrSizeCalculator.hpp>)
#include <fastcdr/CdrSizeCalculator.hpp>
#else
/// Fast CDR 1 (Debian 12) has other names.
namespace eprosima::fastcdr::CdrVersion {
inline constexpr auto XCDRv1 = Cdr::DDS_CDR;
}
#endif

/// Names that differ between Fast CDR 1 (Debian 12) and 2 (Debian 13).
namespace laneloom::dds {

/// The number of bytes that were written, with the encapsulation header.
inline std::size_t written_bytes(const eprosima::fastcdr::Cdr& cdr) {
#if __has_include(<fastcdr/CdrSizeCalculator.hpp>)
  return cdr.get_serialized_data_length();
#else
  return cdr.getSerializedDataLength();
#endif
}

/// The number of bytes that a generated message takes, without the encapsulation header.
template <class Message>
std::size_t bytes_to_write(const Message& message) {
#if __has_include(<fastcdr/CdrSizeCalculator.hpp>)
  eprosima::fastcdr::CdrSizeCalculator calculator(eprosima::fastcdr::CdrVersion::XCDRv1);
  std::size_t alignment = 0;
  return calculator.calculate_serialized_size(message, alignment);
#else
  return Message::getCdrSerializedSize(message);
#endif
}

}  // namespace laneloom::dds
