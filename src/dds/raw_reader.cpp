#include "laneloom/dds/raw_reader.hpp"

#include <utility>

#include "dds/raw_type.hpp"
#include "dds/topic_reader.hpp"

namespace laneloom::dds {

template <class T>
class RawReader<T>::Impl {
 public:
  Impl(std::shared_ptr<Participant::Impl> participant, Callback callback)
      : callback_(std::move(callback)),
        reader_(std::move(participant), topic_of<T, RawType<typename TopicTraits<T>::Type>>(), take(), {}) {}

 private:
  using Readers = TopicReader<Bytes>;

  typename Readers::Take take() {
    return [this](const WriterId& writer, std::uint64_t /*number*/, Bytes* message) {
      if (message != nullptr) callback_(writer, std::move(*message));
    };
  }

  Callback callback_;
  Readers reader_;  // last, so that no callback meets a destroyed member
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
template class RawReader<TrackedObjects>;
template class RawReader<NextTurn>;
template class RawReader<PublishedMap>;
template class RawReader<RoadMarkings>;
template class RawReader<ServiceStatus>;

}  // namespace laneloom::dds
