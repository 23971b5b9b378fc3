#pragma once

#include <cstdint>

#include "laneloom/messages.hpp"

namespace laneloom::test {

/// A map as a service that is well publishes it.
inline PublishedMap published(const LocalMap& map, std::uint64_t sequence) {
  PublishedMap message;
  message.sequence = sequence;
  message.age_s = 0.0;
  message.state = MapState::ok;
  message.map = map;
  return message;
}

}  // namespace laneloom::test
