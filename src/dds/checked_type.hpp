#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <span>
#include <string_view>

#include "cdr/layout.hpp"
#include "cdr/protection.hpp"

namespace laneloom::dds {

/// A received message, or the reason why the received bytes are none.
template <class Message>
struct Sample {
  Message message;
  std::string_view refusal;  ///< "crc", "data_id" or "malformed"; empty: the message is whole
};

/// The generated type support, made safe and protected from end to end. A malformed payload neither throws
/// (which would terminate the process, or be thrown again at every later take) nor allocates as much as it
/// claims to need. It arrives as a sample with a refusal, for the reader to count.
template <class PubSubType>
class CheckedType : public PubSubType {
 public:
  using Message = typename PubSubType::type;
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

  CheckedType() {
    // Otherwise Fast DDS would announce types that it can not describe (the code was generated without
    // -typeobject).
    this->auto_fill_type_object(false);
    this->auto_fill_type_information(false);
  }

  bool deserialize(Payload* payload, void* data) override {
    auto* sample = static_cast<Sample<Message>*>(data);
    const std::span<const std::uint8_t> bytes(payload->data, payload->length);
    sample->refusal = check_protection(bytes, kDataId<Message>);
    if (!sample->refusal.empty()) return true;
    try {
      const bool whole = well_formed<Message>(bytes) && PubSubType::deserialize(payload, &sample->message);
      if (!whole) sample->refusal = "malformed";
    } catch (...) {
      sample->refusal = "malformed";
    }
    return true;
  }
  bool serialize(void* data, Payload* payload) override {
    const bool whole = PubSubType::serialize(&static_cast<Sample<Message>*>(data)->message, payload);
    if (whole) protect({payload->data, payload->length}, kDataId<Message>);
    return whole;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return PubSubType::getSerializedSizeProvider(&static_cast<Sample<Message>*>(data)->message);
  }
  void* createData() override { return new Sample<Message>; }
  void deleteData(void* data) override { delete static_cast<Sample<Message>*>(data); }
};

}  // namespace laneloom::dds
