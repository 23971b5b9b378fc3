#pragma once

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include "dds/fast_dds.hpp"

namespace laneloom::dds {

/// Hands on every sample that a reader has, by `hand_on(Sample&, const SampleInfo&)`.
///
/// Fast DDS leaves a sample that a reliable writer gives up half sent in the list of what a reader may take
/// (StatefulReader::processGapMsg), although its memory waits for another sample. Such an entry has no
/// writer; once the memory is used again, the other sample is in the list twice.
/// - take_next_sample() skips what was read, and ends the process when an entry that it takes equals one that
///   it skipped (an assertion in DataReaderHistory::remove_change_sub). take() of any state skips only what
///   must wait for earlier samples of its writer, as do all its equals: the first of equals is taken first.
/// - Fast DDS 3.1 leaves such an entry in the list even when take() has returned it, until the list has no
///   room for a new sample. take() of any state would return the first such entry for ever. take() marks the
///   entry as read, though, and here only what was not read is taken (kTakenSamples).
/// - The memory must stay allocated: not with the policy DYNAMIC_RESERVE_MEMORY_MODE (qos.cpp).
template <class Sample, class HandOn>
void take_all(eprosima::fastdds::dds::DataReader& reader, HandOn hand_on) {
  using eprosima::fastdds::dds::LENGTH_UNLIMITED;
  eprosima::fastdds::dds::LoanableSequence<Sample> samples(1);
  eprosima::fastdds::dds::SampleInfoSeq infos(1);
  while (reader.take(samples, infos, LENGTH_UNLIMITED, kTakenSamples) == eprosima::fastdds::dds::RETCODE_OK) {
    const bool given_up = infos[0].sample_identity.writer_guid() == eprosima::fastdds::rtps::c_Guid_Unknown;
    if (!given_up) hand_on(samples[0], infos[0]);
    samples.length(0);
    infos.length(0);
  }
}

}  // namespace laneloom::dds
