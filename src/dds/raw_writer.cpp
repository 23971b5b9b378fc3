#include "laneloom/dds/raw_writer.hpp"

#include <utility>

#include "dds/raw_type.hpp"
#include "dds/topic_writer.hpp"

namespace laneloom::dds {

template <class T>
class RawWriter<T>::Impl {
 public:
  explicit Impl(std::shared_ptr<Participant::Impl> participant)
      : writer_(std::move(participant), topic_of<T, RawType<typename TopicTraits<T>::Type>>()) {}

  bool write(const Bytes& message) {
    sample_ = message;
    return writer_.write(&sample_);
  }
  int matched() const { return writer_.matched(); }

 private:
  TopicWriter writer_;
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
template class RawWriter<TrackedObjects>;
template class RawWriter<NextTurn>;
template class RawWriter<PublishedMap>;
template class RawWriter<RoadMarkings>;
template class RawWriter<ServiceStatus>;

}  // namespace laneloom::dds
