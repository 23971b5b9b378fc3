#pragma once

#include <span>
#include <string_view>

#include "cdr/layout.hpp"
#include "cdr/protection.hpp"
#include "dds/generated_type.hpp"

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
class CheckedType : public GeneratedType<PubSubType> {
 public:
  using Message = typename PubSubType::type;
  using typename GeneratedType<PubSubType>::Payload;

  bool read(Payload& payload, void* data) override {
    auto* sample = static_cast<Sample<Message>*>(data);
    const std::span<const std::uint8_t> bytes(payload.data, payload.length);
    sample->refusal = check_protection(bytes, kDataId<Message>);
    if (!sample->refusal.empty()) return true;
    try {
      const bool whole = well_formed<Message>(bytes) && this->read_message(payload, sample->message);
      if (!whole) sample->refusal = "malformed";
    } catch (...) {
      sample->refusal = "malformed";
    }
    return true;
  }
  bool write(const void* data, Payload& payload) override {
    const bool whole = this->write_message(static_cast<const Sample<Message>*>(data)->message, payload);
    if (whole) protect({payload.data, payload.length}, kDataId<Message>);
    return whole;
  }
  std::uint32_t bytes(const void* data) override {
    return this->bytes_of_message(static_cast<const Sample<Message>*>(data)->message);
  }
  void* make_sample() override { return new Sample<Message>; }
  void delete_sample(void* data) override { delete static_cast<Sample<Message>*>(data); }
};

}  // namespace laneloom::dds
