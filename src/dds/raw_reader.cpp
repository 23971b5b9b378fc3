#include "laneloom/dds/raw_reader.hpp"

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <string>
#include <utility>

#include "dds/participant_impl.hpp"
#include "dds/raw_type.hpp"
#include "dds/topic_traits.hpp"

namespace laneloom::dds {

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;

template <class T>
class RawReader<T>::Impl : public DataReaderListener {
 public:
  using Traits = TopicTraits<T>;

  Impl(std::shared_ptr<Participant::Impl> participant, Callback callback)
      : participant_(std::move(participant)), callback_(std::move(callback)) {
    auto* topic = participant_->topic(Traits::kName, TypeSupport(new RawType<typename Traits::Type>));
    reader_ = participant_->subscriber().create_datareader(topic, reader_qos(Traits::kKind), this);
    if (!reader_) throw participant_->refusal(std::string("reader of ") + Traits::kName);
  }
  ~Impl() override {
    reader_->set_listener(nullptr);
    participant_->subscriber().delete_datareader(reader_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void on_data_available(DataReader* reader) override {
    Bytes message;
    SampleInfo info;
    while (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) deliver(std::move(message));
      message.clear();
    }
  }

 private:
  /// Nothing may be thrown into DDS: it would end the process.
  void deliver(Bytes&& message) noexcept {
    try {
      callback_(std::move(message));
    } catch (...) {
    }
  }

  std::shared_ptr<Participant::Impl> participant_;
  Callback callback_;
  DataReader* reader_ = nullptr;
};

template <class T>
RawReader<T>::RawReader(const Participant& participant, Callback callback)
    : impl_(std::make_unique<Impl>(participant.impl(), std::move(callback))) {}
template <class T>
RawReader<T>::RawReader(RawReader&&) noexcept = default;
template <class T>
RawReader<T>& RawReader<T>::operator=(RawReader&&) noexcept = default;
template <class T>
RawReader<T>::~RawReader() = default;

template class RawReader<DetectionFrame>;
template class RawReader<VehiclePose>;
template class RawReader<PublishedMap>;
template class RawReader<RoadMarkings>;
template class RawReader<ServiceStatus>;

}  // namespace laneloom::dds
