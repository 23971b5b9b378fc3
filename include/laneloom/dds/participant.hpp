#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/counters.hpp"
#include "laneloom/error.hpp"

namespace laneloom::dds {

/// A WriterId names one writer in the domain, for as long as the writer lives.
using WriterId = std::array<std::uint8_t, 16>;

/// Opens the files that the configuration names, as a participant would. Throws ConfigError
/// (laneloom/error.hpp) when the profile is missing or invalid, or a file of security is unreadable; whether
/// DDS trusts the files of security only shows when there is a participant. Thread-safe.
void check_files(const DdsConfig& config);

/// Throws ConfigError when the file of the profile is missing. It is not opened. Thread-safe.
void check_profile_file(const DdsConfig& config);

/// The longest datagram, in bytes, that a participant with this configuration receives whole. Fast DDS cuts
/// longer ones without a word. Throws as check_files().
std::uint32_t largest_datagram(const DdsConfig& config);

/// Returns the addresses ("address:port") of the discovery servers that such a participant asks for the
/// others. The list is empty where the participant finds them by itself. Throws as check_files().
std::vector<std::string> discovery_servers(const DdsConfig& config);

/// Is thrown where DDS does not trust the files of security, or they do not permit what is wanted.
struct NotPermitted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The state of a participant's own UDP ports, as the participant finds it.
struct SelfCheck {
  /// How many datagrams in a row one of the ports has not taken, in the worst case. If the number keeps
  /// rising, discovery or the reception of messages hangs.
  int unanswered = 0;
  /// A port that took datagrams before has an address that this host no longer has. What cannot be sent there
  /// is not unanswered.
  bool address_gone = false;
};

/// One participant in the domain, in the partition of one vehicle. Readers and writers keep it alive.
/// Not thread-safe; not to be used within a reader's callback.
class Participant {
 public:
  /// A hidden participant neither hears others nor is heard. It only serves to see what DDS refuses.
  enum class Presence { shown, hidden };
  /// `name` is shown to others. Throws ConfigError for a value outside its range and as check_files(),
  /// NotPermitted where there is security and DDS refuses, else std::runtime_error.
  Participant(const DdsConfig& config, const std::string& name, Presence presence = Presence::shown);

  /// The received datagrams that were not handed to DDS: datagrams_refused_<reason>. Thread-safe.
  Counters refused_datagrams() const;
  /// Sends a datagram to each of the participant's own UDP ports. Does not wait; thread-safe.
  SelfCheck ask_itself();

  class Impl;
  const std::shared_ptr<Impl>& impl() const { return impl_; }  ///< for readers and writers

 private:
  std::shared_ptr<Impl> impl_;
};

}  // namespace laneloom::dds
