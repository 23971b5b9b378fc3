#include "laneloom/dds/raw_writer.hpp"

#include <fastdds/dds/publisher/DataWriter.hpp>

#include <string>
#include <utility>

#include "dds/participant_impl.hpp"
#include "dds/raw_type.hpp"
#include "dds/topic_traits.hpp"

namespace laneloom::dds {

using namespace eprosima::fastdds::dds;

template <class T>
class RawWriter<T>::Impl {
 public:
  using Traits = TopicTraits<T>;

  explicit Impl(std::shared_ptr<Participant::Impl> participant) : participant_(std::move(participant)) {
    auto* topic = participant_->topic(Traits::kName, TypeSupport(new RawType<typename Traits::Type>));
    writer_ = participant_->publisher().create_datawriter(topic, writer_qos(Traits::kKind));
    if (!writer_) throw participant_->refusal(std::string("writer of ") + Traits::kName);
  }
  ~Impl() { participant_->publisher().delete_datawriter(writer_); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool write(const Bytes& message) {
    sample_ = message;
    return writer_->write(&sample_);
  }
  int matched() const {
    PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }

 private:
  std::shared_ptr<Participant::Impl> participant_;
  DataWriter* writer_ = nullptr;
  Bytes sample_;
};

template <class T>
RawWriter<T>::RawWriter(const Participant& participant) : impl_(std::make_unique<Impl>(participant.impl())) {}
template <class T>
RawWriter<T>::RawWriter(RawWriter&&) noexcept = default;
template <class T>
RawWriter<T>& RawWriter<T>::operator=(RawWriter&&) noexcept = default;
template <class T>
RawWriter<T>::~RawWriter() = default;

template <class T>
bool RawWriter<T>::write(const std::vector<std::uint8_t>& message) {
  return impl_->write(message);
}
template <class T>
int RawWriter<T>::matched() const {
  return impl_->matched();
}

template class RawWriter<DetectionFrame>;
template class RawWriter<VehiclePose>;
template class RawWriter<PublishedMap>;
template class RawWriter<RoadMarkings>;
template class RawWriter<ServiceStatus>;

}  // namespace laneloom::dds
