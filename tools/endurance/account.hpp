#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "laneloom/messages.hpp"
#include "support/publication_log.hpp"

namespace laneloom {

/// What became of the detection frames that were published to one session of the service, between the first
/// and the last of each source that it saw.
struct Account {
  std::uint64_t published = 0;  ///< by the publishers' own logs
  std::uint64_t fused = 0;
  std::uint64_t refused = 0;
  std::uint64_t dropped = 0;
  std::uint64_t pending = 0;
  std::uint64_t lost = 0;  ///< on the way

  std::int64_t unexplained() const {
    return static_cast<std::int64_t>(published - fused - refused - dropped - pending - lost);
  }
};

/// By the last status of that session. `sources` are those of all its statuses, as one may name the newest
/// only.
Account account_of(const ServiceStatus& last, const std::vector<SourceStatus>& sources,
                   const std::vector<PublicationLog>& logs);

}  // namespace laneloom
