#include "laneloom/dds/reader.hpp"

#include <atomic>
#include <utility>

#include "cdr/convert.hpp"
#include "dds/topic_reader.hpp"

namespace laneloom::dds {

template <class T>
class Reader<T>::Impl {
 public:
  Impl(std::shared_ptr<Participant::Impl> participant, ReaderCallbacks<T> callbacks)
      : callbacks_(std::move(callbacks)),
        frame_id_(participant->map_frame_id()),
        reader_(std::move(participant), topic_of<T, typename TopicTraits<T>::Type>(), take(), events()) {}

  int matched() const { return matched_; }

 private:
  using Received = Sample<MessageOf<T>>;
  using Readers = TopicReader<Received>;

  typename Readers::Take take() {
    return [this](const WriterId& writer, std::uint64_t number, Received* sample) {
      call(callbacks_.numbered, writer, number);
      if (sample != nullptr) receive(*sample);
    };
  }
  typename Readers::Events events() {
    const auto matched = [this](int writers) {
      matched_ = writers;
      call(callbacks_.matched, writers);
    };
    return {matched, callbacks_.alive, callbacks_.deadline_missed};
  }
  void receive(Received& sample) noexcept {
    try {
      T message;
      const auto refusal =
          sample.refusal.empty() ? from_msg(std::move(sample.message), frame_id_, message) : sample.refusal;
      if (refusal.empty()) {
        call(callbacks_.sample, std::move(message));
      } else {
        call(callbacks_.refused, refusal);
      }
    } catch (const std::bad_alloc&) {
      call(callbacks_.refused, "malformed");
    }
  }

  ReaderCallbacks<T> callbacks_;
  std::string frame_id_;
  std::atomic<int> matched_ = 0;
  Readers reader_;  // last, so that no callback meets a destroyed member
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
template class Reader<TrackedObjects>;
template class Reader<NextTurn>;
template class Reader<PublishedMap>;
template class Reader<RoadMarkings>;
template class Reader<ServiceStatus>;

}  // namespace laneloom::dds
