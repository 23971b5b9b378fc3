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
/// - With Fast DDS 3.1, take() returns such an entry, but leaves it in the list until a sample has no room
///   there. So each take() asks for one sample more than there are such entries.
/// - The memory must stay allocated: not with the policy DYNAMIC_RESERVE_MEMORY_MODE (qos.cpp).
template <class Sample, class HandOn>
void take_all(eprosima::fastdds::dds::DataReader& reader, HandOn hand_on) {
  int room = 1;
  while (true) {
    eprosima::fastdds::dds::LoanableSequence<Sample> samples(room);
    eprosima::fastdds::dds::SampleInfoSeq infos(room);
    if (reader.take(samples, infos) != eprosima::fastdds::dds::RETCODE_OK) return;
    int given_up = 0;
    for (int i = 0; i < infos.length(); ++i) {
      if (infos[i].sample_identity.writer_guid() == eprosima::fastdds::rtps::c_Guid_Unknown)
        ++given_up;
      else
        hand_on(samples[i], infos[i]);
    }
    if (infos.length() < room) return;
    room = given_up + 1;
  }
}

}  // namespace laneloom::dds
