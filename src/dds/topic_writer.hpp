#pragma once

#include <fastdds/dds/publisher/DataWriter.hpp>

#include <memory>
#include <string>
#include <utility>

#include "dds/participant_impl.hpp"
#include "dds/topic_traits.hpp"

namespace laneloom::dds {

/// A DDS writer of the topic of T, whose samples are as `Type` supports them.
template <class T, class Type>
class TopicWriter {
 public:
  explicit TopicWriter(std::shared_ptr<Participant::Impl> participant)
      : participant_(std::move(participant)) {
    using Traits = TopicTraits<T>;
    auto* topic = participant_->topic(Traits::kName, eprosima::fastdds::dds::TypeSupport(new Type));
    writer_ = participant_->publisher().create_datawriter(topic, writer_qos(Traits::kKind));
    if (!writer_) participant_->refuse(std::string("writer of ") + Traits::kName);
  }
  ~TopicWriter() { participant_->publisher().delete_datawriter(writer_); }
  TopicWriter(const TopicWriter&) = delete;
  TopicWriter& operator=(const TopicWriter&) = delete;

  Participant::Impl& participant() const { return *participant_; }
  bool write(void* sample) { return writer_->write(sample); }
  int matched() const {
    eprosima::fastdds::dds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }

 private:
  std::shared_ptr<Participant::Impl> participant_;
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
};

}  // namespace laneloom::dds
