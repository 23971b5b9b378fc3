#pragma once

#include <algorithm>

#include "dds/fast_dds.hpp"
#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

inline WriterId id_of(const eprosima::fastdds::rtps::GUID_t& guid) {
  WriterId writer;
  auto* const entity =
      std::copy_n(guid.guidPrefix.value, eprosima::fastdds::rtps::GuidPrefix_t::size, writer.begin());
  std::copy_n(guid.entityId.value, eprosima::fastdds::rtps::EntityId_t::size, entity);
  return writer;
}

}  // namespace laneloom::dds
