#pragma once

#include <cstdint>
#include <functional>

#include "dds/fast_dds.hpp"

namespace laneloom::dds {

/// The type support that fastddsgen has made, with functions to override: how a sample becomes bytes and the
/// other way round, and what a sample is.
template <class PubSubType>
class GeneratedType : public PubSubType {
 public:
  using Payload = eprosima::fastdds::rtps::SerializedPayload_t;

  virtual bool read(Payload& from, void* sample) = 0;
  virtual bool write(const void* sample, Payload& to) = 0;
  /// The size of the payload, with the encapsulation header.
  virtual std::uint32_t bytes(const void* sample) = 0;
  virtual void* make_sample() = 0;
  virtual void delete_sample(void* sample) = 0;

 protected:
  using Message = typename PubSubType::type;

#if LANELOOM_FAST_DDS == 3
  bool read_message(Payload& from, Message& to) { return PubSubType::deserialize(from, &to); }
  bool write_message(const Message& from, Payload& to) { return PubSubType::serialize(&from, to, kXcdr1); }
  std::uint32_t bytes_of_message(const Message& message) {
    return PubSubType::calculate_serialized_size(&message, kXcdr1);
  }

 private:
  using Representation = eprosima::fastdds::dds::DataRepresentationId_t;
  static constexpr auto kXcdr1 = eprosima::fastdds::dds::XCDR_DATA_REPRESENTATION;

  bool deserialize(Payload& payload, void* data) final { return read(payload, data); }
  bool serialize(const void* data, Payload& payload, Representation /*ours is XCDR1*/) final {
    return write(data, payload);
  }
  std::uint32_t calculate_serialized_size(const void* data, Representation /*ours is XCDR1*/) final {
    return bytes(data);
  }
  void* create_data() final { return make_sample(); }
  void delete_data(void* data) final { delete_sample(data); }
#else
  GeneratedType() { announce_as(this->getName(), *this); }
  bool read_message(Payload& from, Message& to) { return PubSubType::deserialize(&from, &to); }
  bool write_message(const Message& from, Payload& to) {
    return PubSubType::serialize(const_cast<Message*>(&from), &to);
  }
  std::uint32_t bytes_of_message(const Message& message) {
    return PubSubType::getSerializedSizeProvider(const_cast<Message*>(&message))();
  }

 private:
  bool deserialize(Payload* payload, void* data) final { return read(*payload, data); }
  bool serialize(void* data, Payload* payload) final { return write(data, *payload); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) final {
    return [this, data] { return bytes(data); };
  }
  void* createData() final { return make_sample(); }
  void deleteData(void* data) final { delete_sample(data); }
#endif
};

}  // namespace laneloom::dds
