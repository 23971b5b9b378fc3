#include "laneloom/dds/writer.hpp"

#include <utility>

#include "cdr/convert.hpp"
#include "dds/topic_writer.hpp"

namespace laneloom::dds {

template <class T>
class Writer<T>::Impl {
 public:
  explicit Impl(std::shared_ptr<Participant::Impl> participant)
      : writer_(std::move(participant), topic_of<T, typename TopicTraits<T>::Type>()) {}

  bool write(const T& message) {
    left_out_ += to_msg(message, writer_.participant().map_frame_id(), sample_.message);
    return writer_.write(&sample_);
  }
  std::uint64_t left_out() const { return left_out_; }
  int matched() const { return writer_.matched(); }

 private:
  TopicWriter writer_;
  Sample<MessageOf<T>> sample_;  // kept, so that its memory is reused
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
template class Writer<TrackedObjects>;
template class Writer<NextTurn>;
template class Writer<PublishedMap>;
template class Writer<RoadMarkings>;
template class Writer<ServiceStatus>;

}  // namespace laneloom::dds
