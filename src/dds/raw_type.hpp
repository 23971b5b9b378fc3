#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "dds/fast_dds.hpp"

namespace laneloom::dds {

using Bytes = std::vector<std::uint8_t>;

/// A type support with the name and size of the topic's type, whose samples are the payloads themselves.
template <class CheckedType>
class RawType : public CheckedType {
 public:
  using typename CheckedType::Payload;

  bool read(Payload& payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload.data, payload.data + payload.length);
    return true;
  }
  bool write(const void* data, Payload& payload) override {
    const Bytes& message = *static_cast<const Bytes*>(data);
    if (message.size() < kEncapsulationBytes || message.size() > payload.max_size) return false;
    std::memcpy(payload.data, message.data(), message.size());
    payload.length = static_cast<std::uint32_t>(message.size());
    payload.encapsulation = message[1];
    return true;
  }
  std::uint32_t bytes(const void* data) override {
    return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size());
  }
  void* make_sample() override { return new Bytes; }
  void delete_sample(void* data) override { delete static_cast<Bytes*>(data); }

 private:
  static constexpr std::size_t kEncapsulationBytes = 4;
};

}  // namespace laneloom::dds
