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
  std::string id;       ///< its GUID's prefix
  std::string name;     ///< what it calls itself; may be empty, and is no more than its word
  std::string address;  ///< the first that it receives data at; empty: it told none
};

/// A writer's durability tells how long it keeps samples for readers that come later. A later value offers
/// more.
enum class Durability { volatile_, transient_local, transient, persistent };
/// A writer's liveliness tells who says that it is alive. A later value offers more.
enum class Liveliness { automatic, manual_by_participant, manual_by_topic };

/// A writer or a reader of another participant, with the quality of service that decides on a match.
struct Endpoint {
  bool is_writer = false;
  Peer participant;
  std::string topic, type;
  std::vector<std::string> partitions;  ///< none: the default one, whose name is empty
  bool reliable = false;
  Durability durability = Durability::volatile_;
  std::optional<double> deadline_s;  ///< none: infinite
  Liveliness liveliness = Liveliness::automatic;
  std::optional<double> lease_s;  ///< of the liveliness; none: infinite
  bool exclusive = false;         ///< ownership
  WriterId id{};                  ///< of a writer
};

/// Who else is in the domain, in any partition, and what they write and read. It has a participant of its
/// own, which sees all but itself. With DDS-Security, endpoints of others show once they trust this one.
class Discovery {
 public:
  /// `name` is shown to others. Throws as Participant does.
  Discovery(const DdsConfig& config, const std::string& name);
  Discovery(Discovery&&) noexcept;
  Discovery& operator=(Discovery&&) noexcept;
  ~Discovery();

  /// Those who are there now. May be called from any thread.
  std::vector<Peer> participants() const;
  /// Their writers and readers that are there now. May be called from any thread.
  std::vector<Endpoint> endpoints() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
