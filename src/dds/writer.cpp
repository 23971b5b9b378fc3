#include "laneloom/dds/writer.hpp"

#include <fastdds/dds/publisher/DataWriter.hpp>

#include <string>
#include <utility>

#include "dds/convert.hpp"
#include "dds/participant_impl.hpp"
#include "dds/topic_traits.hpp"

namespace laneloom::dds {

using namespace eprosima::fastdds::dds;

template <class T>
class Writer<T>::Impl {
 public:
  using Traits = TopicTraits<T>;

  explicit Impl(std::shared_ptr<Participant::Impl> participant) : participant_(std::move(participant)) {
    auto* topic = participant_->topic(Traits::kName, TypeSupport(new typename Traits::Type));
    writer_ = participant_->publisher().create_datawriter(topic, writer_qos(Traits::kKind));
    if (!writer_) throw participant_->refusal(std::string("writer of ") + Traits::kName);
  }
  ~Impl() { participant_->publisher().delete_datawriter(writer_); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool write(const T& message) {
    left_out_ += to_msg(message, participant_->map_frame_id(), sample_.message);
    return writer_->write(&sample_);
  }
  std::uint64_t left_out() const { return left_out_; }
  int matched() const {
    PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }

 private:
  std::shared_ptr<Participant::Impl> participant_;
  DataWriter* writer_ = nullptr;
  Sample<MessageOf<T>> sample_;  // kept, so that its memory is used again
  std::uint64_t left_out_ = 0;
};

template <class T>
Writer<T>::Writer(const Participant& participant) : impl_(std::make_unique<Impl>(participant.impl())) {}
template <class T>
Writer<T>::Writer(Writer&&) noexcept = default;
template <class T>
Writer<T>& Writer<T>::operator=(Writer&&) noexcept = default;
template <class T>
Writer<T>::~Writer() = default;

template <class T>
bool Writer<T>::write(const T& message) {
  return impl_->write(message);
}
template <class T>
std::uint64_t Writer<T>::left_out() const {
  return impl_->left_out();
}
template <class T>
int Writer<T>::matched() const {
  return impl_->matched();
}

template class Writer<DetectionFrame>;
template class Writer<VehiclePose>;
template class Writer<PublishedMap>;
template class Writer<RoadMarkings>;
template class Writer<ServiceStatus>;

}  // namespace laneloom::dds
