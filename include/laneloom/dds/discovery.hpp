#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/dds/participant.hpp"

namespace laneloom::dds {

/// A participant as others see it.
struct Peer {
  std::string id;       ///< the prefix of its GUID
  std::string name;     ///< the name that it gives itself, unchecked; may be empty
  std::string address;  ///< the first address at which it receives data; empty: it told none
};

/// A writer's durability tells how long it keeps samples for readers that come later. A later value offers
/// more.
enum class Durability { volatile_, transient_local, transient, persistent };
/// A writer's liveliness tells who asserts that it is alive. A later value offers more.
enum class Liveliness { automatic, manual_by_participant, manual_by_topic };

/// A writer or a reader of another participant, with the quality of service that decides on a match.
struct Endpoint {
  bool is_writer = false;               ///< else it is a reader
  Peer participant;                     ///< whose endpoint it is
  std::string topic, type;              ///< names as on DDS
  std::vector<std::string> partitions;  ///< empty: the default partition
  bool reliable = false;                ///< else best effort
  Durability durability = Durability::volatile_;
  std::optional<double> deadline_s;  ///< between two samples; none: infinite
  Liveliness liveliness = Liveliness::automatic;
  std::optional<double> lease_s;  ///< of the liveliness; none: infinite
  bool exclusive = false;         ///< ownership of samples is exclusive, else shared
  WriterId id{};                  ///< only of a writer
};

/// Finds the other participants of the domain, in any partition, and their writers and readers. It has a
/// participant of its own, which sees all but itself. With DDS-Security, endpoints of others show once they
/// trust this participant.
class Discovery {
 public:
  /// `name` is shown to others. Throws as Participant does.
  Discovery(const DdsConfig& config, const std::string& name);
  Discovery(Discovery&&) noexcept;
  Discovery& operator=(Discovery&&) noexcept;
  ~Discovery();

  /// The participants that are there now. May be called from any thread.
  std::vector<Peer> participants() const;
  /// The writers and readers that are there now. May be called from any thread.
  std::vector<Endpoint> endpoints() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
