#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "laneloom/messages.hpp"
#include "support/publication_log.hpp"

namespace laneloom::endurance {

/// Accounts for the detection frames that were published to one session of the service, from the first to the
/// last frame that it saw of each source.
struct Account {
  std::uint64_t published = 0;  ///< by the publishers' own logs
  std::uint64_t fused = 0;
  std::uint64_t refused = 0;
  std::uint64_t dropped = 0;
  std::uint64_t pending = 0;
  std::uint64_t lost = 0;  ///< on the way to the service

  std::int64_t unexplained() const {
    return static_cast<std::int64_t>(published - fused - refused - dropped - pending - lost);
  }
};

/// The account of a session, by its last status. `sources` are gathered from all its statuses, because a
/// single one names the newest sources only.
Account account_of(const ServiceStatus& last, const std::vector<SourceStatus>& sources,
                   const std::vector<support::PublicationLog>& logs);

}  // namespace laneloom::endurance
