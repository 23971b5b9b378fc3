#include "laneloom/dds/reader.hpp"

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include "cdr/convert.hpp"
#include "dds/participant_impl.hpp"
#include "dds/topic_traits.hpp"

namespace laneloom::dds {

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;

namespace {

/// Nothing may be thrown into DDS: it would end the process.
template <class... Arguments, class... Values>
void call(const std::function<void(Arguments...)>& callback, Values&&... values) noexcept {
  if (!callback) return;
  try {
    callback(std::forward<Values>(values)...);
  } catch (...) {
  }
}

}  // namespace

template <class T>
class Reader<T>::Impl : public DataReaderListener {
 public:
  using Traits = TopicTraits<T>;

  Impl(std::shared_ptr<Participant::Impl> participant, ReaderCallbacks<T> callbacks)
      : participant_(std::move(participant)), callbacks_(std::move(callbacks)) {
    auto* topic = participant_->topic(Traits::kName, TypeSupport(new typename Traits::Type));
    reader_ = participant_->subscriber().create_datareader(topic, reader_qos(Traits::kKind), this);
    if (!reader_) throw participant_->refusal(std::string("reader of ") + Traits::kName);
  }
  ~Impl() override {
    reader_->set_listener(nullptr);
    participant_->subscriber().delete_datareader(reader_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  int matched() const { return matched_; }

  void on_data_available(DataReader* reader) override {
    Sample<MessageOf<T>> sample;
    SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
      number(info.sample_identity);
      if (info.valid_data) receive(sample);
    }
  }
  void on_subscription_matched(DataReader* /*reader*/, const SubscriptionMatchedStatus& status) override {
    matched_ = status.current_count;
    call(callbacks_.matched, status.current_count);
  }
  void on_liveliness_changed(DataReader* /*reader*/, const LivelinessChangedStatus& status) override {
    call(callbacks_.alive, status.alive_count);
  }
  void on_requested_deadline_missed(DataReader* /*reader*/,
                                    const RequestedDeadlineMissedStatus& status) override {
    call(callbacks_.deadline_missed, status.total_count);
  }

 private:
  void number(const eprosima::fastrtps::rtps::SampleIdentity& sample) noexcept {
    const auto& guid = sample.writer_guid();
    WriterId writer;
    const auto entity = std::copy_n(guid.guidPrefix.value, guid.guidPrefix.size, writer.begin());
    std::copy_n(guid.entityId.value, guid.entityId.size, entity);
    call(callbacks_.numbered, writer, sample.sequence_number().to64long());
  }
  void receive(const Sample<MessageOf<T>>& sample) noexcept {
    try {
      T message;
      const auto refusal =
          sample.well_formed ? from_msg(sample.message, participant_->map_frame_id(), message) : "malformed";
      if (refusal.empty()) {
        call(callbacks_.sample, std::move(message));
      } else {
        call(callbacks_.refused, refusal);
      }
    } catch (const std::bad_alloc&) {
      call(callbacks_.refused, "malformed");
    }
  }

  std::shared_ptr<Participant::Impl> participant_;
  ReaderCallbacks<T> callbacks_;
  DataReader* reader_ = nullptr;
  std::atomic<int> matched_ = 0;
};

template <class T>
Reader<T>::Reader(const Participant& participant, ReaderCallbacks<T> callbacks)
    : impl_(std::make_unique<Impl>(participant.impl(), std::move(callbacks))) {}
template <class T>
Reader<T>::Reader(Reader&&) noexcept = default;
template <class T>
Reader<T>& Reader<T>::operator=(Reader&&) noexcept = default;
template <class T>
Reader<T>::~Reader() = default;

template <class T>
int Reader<T>::matched() const {
  return impl_->matched();
}

template class Reader<DetectionFrame>;
template class Reader<VehiclePose>;
template class Reader<PublishedMap>;
template class Reader<RoadMarkings>;
template class Reader<ServiceStatus>;

}  // namespace laneloom::dds
