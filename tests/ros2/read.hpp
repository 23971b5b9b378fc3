#pragma once

#include <gtest/gtest.h>

#include <cstddef>
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

/// Expects that a message is read from all of its bytes, and from no fewer or more.
template <class Type>
void expect_only_whole(const std::vector<std::uint8_t>& bytes) {
  EXPECT_EQ(read<Type>(bytes).refusal, "");
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(read<Type>({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}).refusal,
              "malformed")
        << size;
  auto longer = bytes;
  longer.resize(bytes.size() + 4);
  EXPECT_EQ(read<Type>(longer).refusal, "malformed");
}

}  // namespace laneloom
