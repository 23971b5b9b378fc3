#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>

#include "cdr/layout.hpp"

namespace laneloom::dds {

/// What a reader takes: a message, or the knowledge that one came which was none.
template <class Message>
struct Sample {
  Message message;
  bool well_formed = true;
};

/// The generated type support, made safe: a payload that is malformed neither throws (which would terminate
/// the process, or be thrown again at every later take) nor allocates what it claims to need. It arrives as a
/// sample that says so, for the reader to count.
template <class PubSubType>
class CheckedType : public PubSubType {
 public:
  using Message = typename PubSubType::type;
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

  CheckedType() {
    // Without these, Fast DDS would announce types that it could not describe (no -typeobject).
    this->auto_fill_type_object(false);
    this->auto_fill_type_information(false);
  }

  bool deserialize(Payload* payload, void* data) override {
    auto* sample = static_cast<Sample<Message>*>(data);
    try {
      sample->well_formed = well_formed<Message>({payload->data, payload->length}) &&
                            PubSubType::deserialize(payload, &sample->message);
    } catch (...) {
      sample->well_formed = false;
    }
    return true;
  }
  bool serialize(void* data, Payload* payload) override {
    return PubSubType::serialize(&static_cast<Sample<Message>*>(data)->message, payload);
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return PubSubType::getSerializedSizeProvider(&static_cast<Sample<Message>*>(data)->message);
  }
  void* createData() override { return new Sample<Message>; }
  void deleteData(void* data) override { delete static_cast<Sample<Message>*>(data); }
};

}  // namespace laneloom::dds
