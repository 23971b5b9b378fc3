#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <algorithm>

#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

inline WriterId id_of(const eprosima::fastrtps::rtps::GUID_t& guid) {
  WriterId writer;
  auto* const entity =
      std::copy_n(guid.guidPrefix.value, eprosima::fastrtps::rtps::GuidPrefix_t::size, writer.begin());
  std::copy_n(guid.entityId.value, eprosima::fastrtps::rtps::EntityId_t::size, entity);
  return writer;
}

}  // namespace laneloom::dds
