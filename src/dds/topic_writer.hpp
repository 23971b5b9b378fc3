#pragma once

#include <fastdds/dds/publisher/DataWriter.hpp>

#include <memory>
#include <string>
#include <utility>

#include "dds/fast_dds.hpp"
#include "dds/participant_impl.hpp"
#include "dds/topic_traits.hpp"

namespace laneloom::dds {

/// A DDS writer of one topic.
class TopicWriter {
 public:
  TopicWriter(std::shared_ptr<Participant::Impl> participant, const TopicDescription& description)
      : participant_(std::move(participant)) {
    auto* topic = participant_->topic(description.name, description.type);
    auto qos = writer_qos(description.kind);
    set_user_data(description.user_data, qos);
    writer_ = participant_->publisher().create_datawriter(topic, qos);
    if (!writer_) participant_->refuse("writer of " + description.name);
  }
  ~TopicWriter() { participant_->publisher().delete_datawriter(writer_); }
  TopicWriter(const TopicWriter&) = delete;
  TopicWriter& operator=(const TopicWriter&) = delete;

  Participant::Impl& participant() const { return *participant_; }
  bool write(void* sample) {
    namespace dds = eprosima::fastdds::dds;
    return writer_->write(sample, dds::HANDLE_NIL) == dds::RETCODE_OK;
  }
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
