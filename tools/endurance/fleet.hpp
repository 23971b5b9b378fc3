#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/child_process.hpp"
#include "bench/publication_log.hpp"
#include "endurance/planner_output.hpp"
#include "io/work_folder.hpp"
#include "laneloom/config.hpp"

namespace laneloom {

/// A publisher, a service and a planner of one vehicle, as processes; each start of one is a session of its
/// own.
class Fleet {
 public:
  struct Spec {
    std::filesystem::path service;  ///< laneloomd
    std::filesystem::path command;  ///< laneloom
    DdsConfig dds;
    std::string scenario = "town";
    std::string noise = "inhouse";
  };
  /// Starts all three. Throws std::runtime_error where one cannot be started.
  explicit Fleet(Spec spec);

  enum class Member { publisher, service, planner };
  static const char* name(Member member);
  void signal(Member member, int number);
  /// Ends it at once, as a crash does, and starts it again.
  void kill_and_restart(Member member);
  /// Ends it as an operator does, and starts it again. Returns what was wrong with its end, in words.
  std::string restart(Member member);
  /// Ends it as an operator does. Returns likewise.
  std::string stop(Member member);
  /// Those that have ended without being told to; they are started again.
  std::vector<Member> restart_ended();

  /// Waits for a map at the planner, as wait_for_planner() does.
  bool planner_gets_maps(const MapNumber& newest, std::chrono::seconds patience) const;

  /// What all publishers so far wrote down of themselves.
  std::vector<PublicationLog> publications() const;

 private:
  void start(Member member);
  std::vector<std::string> command_of(Member member);
  std::vector<std::string> vehicle() const;
  std::string output_of(Member member) const { return folder_.file(name(member)); }

  Spec spec_;
  WorkFolder folder_;
  std::vector<std::string> logs_;                              ///< of the publishers, a file each
  std::map<Member, std::unique_ptr<ChildProcess>> processes_;  ///< those that are to run
};

}  // namespace laneloom
