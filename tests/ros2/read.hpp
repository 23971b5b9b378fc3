#pragma once

#include <cstdint>
#include <vector>

namespace laneloom {

/// The sample that a reader whose type support is `Type` makes of these bytes.
template <class Type>
typename Type::Sample read(std::vector<std::uint8_t> bytes) {
  Type type;
  typename Type::Sample sample;
  typename Type::Payload payload;
  payload.data = bytes.data();
  payload.length = payload.max_size = static_cast<std::uint32_t>(bytes.size());
  type.read(payload, &sample);
  payload.data = nullptr;  // it is none of the payload's to free
  return sample;
}

}  // namespace laneloom
