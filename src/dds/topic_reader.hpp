#pragma once

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "dds/participant_impl.hpp"
#include "dds/sample_numbers.hpp"
#include "dds/take_all.hpp"
#include "dds/topic_traits.hpp"
#include "dds/writer_id.hpp"

namespace laneloom::dds {

/// Calls a callback, and swallows what it throws: an exception within DDS would end the process.
template <class... Arguments, class... Values>
void call(const std::function<void(Arguments...)>& callback, Values&&... values) noexcept {
  if (!callback) return;
  try {
    callback(std::forward<Values>(values)...);
  } catch (...) {
  }
}

/// The DDS readers of one topic, one for each reliability that reader_reliabilities() names. A sample that
/// several of them receive is handed on once. Samples are handed on one at a time.
template <class Sample>
class TopicReader : public eprosima::fastdds::dds::DataReaderListener {
 public:
  using DataReader = eprosima::fastdds::dds::DataReader;
  /// Takes a sample. `sample` is null if the writer only told of its end.
  using Take = std::function<void(const WriterId& writer, std::uint64_t number, Sample* sample)>;
  /// Callbacks with the meaning of those in ReaderCallbacks.
  struct Events {
    std::function<void(int writers)> matched, alive;
    std::function<void(std::uint64_t)> deadline_missed;
  };

  TopicReader(std::shared_ptr<Participant::Impl> participant, const TopicDescription& description, Take take,
              Events events)
      : participant_(std::move(participant)),
        kind_(description.kind),
        take_(std::move(take)),
        events_(std::move(events)) {
    auto* topic = participant_->topic(description.name, description.type);
    for (const auto reliability : reader_reliabilities(kind_, participant_->has_identity())) {
      auto qos = reader_qos(kind_, reliability);
      set_user_data(description.user_data, qos);
      auto* reader = participant_->subscriber().create_datareader(topic, qos, this);
      if (reader == nullptr) {
        end();
        participant_->refuse("reader of " + description.name);
      }
      readers_.push_back(reader);
    }
  }
  ~TopicReader() override { end(); }
  TopicReader(const TopicReader&) = delete;
  TopicReader& operator=(const TopicReader&) = delete;

  Participant::Impl& participant() const { return *participant_; }

  void on_data_available(DataReader* reader) override {
    take_all<Sample>(*reader, [this](Sample& sample, const eprosima::fastdds::dds::SampleInfo& info) {
      const WriterId writer = id_of(info.sample_identity.writer_guid());
      const std::uint64_t number = info.sample_identity.sequence_number().to64long();
      const std::lock_guard lock(mutex_);
      if (numbers_.is_new(writer, number)) call(take_, writer, number, info.valid_data ? &sample : nullptr);
    });
  }
  void on_subscription_matched(DataReader* reader,
                               const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override {
    if (tells(reader)) call(events_.matched, status.current_count);
  }
  void on_liveliness_changed(DataReader* reader,
                             const eprosima::fastdds::dds::LivelinessChangedStatus& status) override {
    if (tells(reader)) call(events_.alive, status.alive_count);
  }
  void on_requested_deadline_missed(
      DataReader* reader, const eprosima::fastdds::dds::RequestedDeadlineMissedStatus& status) override {
    if (tells(reader)) call(events_.deadline_missed, status.total_count);
  }

 private:
  /// Whether the events of a reader are reported: only those of the first one, which matches every writer
  /// that another one matches.
  bool tells(const DataReader* reader) const {
    return reader->get_qos().reliability().kind ==
           reader_reliabilities(kind_, participant_->has_identity()).front();
  }
  void end() {
    for (auto* reader : readers_) reader->set_listener(nullptr);
    for (auto* reader : readers_) participant_->subscriber().delete_datareader(reader);
  }

  std::shared_ptr<Participant::Impl> participant_;
  TopicKind kind_;
  Take take_;
  Events events_;
  std::mutex mutex_;
  SampleNumbers numbers_;
  std::vector<DataReader*> readers_;
};

}  // namespace laneloom::dds
