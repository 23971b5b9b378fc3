#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include <fastdds/dds/topic/TopicDataType.hpp>

namespace laneloom::dds {

using Bytes = std::vector<std::uint8_t>;

/// A type support with the name and size of the topic's type, whose samples are the payloads themselves.
template <class CheckedType>
class RawType : public CheckedType {
 public:
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

  bool deserialize(Payload* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  bool serialize(void* data, Payload* payload) override {
    const Bytes& message = *static_cast<Bytes*>(data);
    if (message.size() < kEncapsulationBytes || message.size() > payload->max_size) return false;
    std::memcpy(payload->data, message.data(), message.size());
    payload->length = static_cast<std::uint32_t>(message.size());
    payload->encapsulation = message[1];
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }

 private:
  static constexpr std::size_t kEncapsulationBytes = 4;
};

}  // namespace laneloom::dds
