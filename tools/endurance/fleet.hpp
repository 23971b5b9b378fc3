#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "endurance/planner_output.hpp"
#include "io/work_folder.hpp"
#include "laneloom/config.hpp"
#include "support/child_process.hpp"
#include "support/publication_log.hpp"

namespace laneloom::endurance {

/// The processes of one vehicle: a publisher, a service, a planner, further perceptions, and a stranger. Each
/// start of a process is a session of its own.
class Fleet {
 public:
  struct Spec {
    std::filesystem::path service;  ///< laneloomd
    std::filesystem::path command;  ///< laneloom
    DdsConfig dds;
    std::string scenario = "town";
    std::string noise = "inhouse";
    /// Programs of further perceptions, of any vendor. Each is run as PROGRAM DOMAIN VEHICLE_ID FILE. It
    /// gives its frames the stamps of poses and the program's name as their source, and writes to FILE as a
    /// PublicationLogWriter does.
    std::vector<std::filesystem::path> perceptions;
    /// The program of someone who sends damaged datagrams to the service, in the names of the others, and the
    /// captures of datagrams that he makes them of. He is run as PROGRAM --only laneloomd DOMAIN 0 SEED
    /// CAPTURE... Empty: there is nobody.
    std::vector<std::string> stranger;
  };
  /// Starts all processes. Throws std::runtime_error if one cannot be started.
  explicit Fleet(Spec spec);

  /// The name of a process: one of those below, or that of a perception's program.
  using Member = std::string;
  static constexpr const char* kPublisher = "publisher";
  static constexpr const char* kService = "service";
  static constexpr const char* kPlanner = "planner";
  static constexpr const char* kStranger = "stranger";
  std::vector<Member> members() const;
  void signal(const Member& member, int number);
  /// Kills a process, as a crash would end it, and starts it again.
  void kill_and_restart(const Member& member);
  /// Ends a process as an operator does, and starts it again. Returns the problem with its end, in words;
  /// empty: there was none.
  std::string restart(const Member& member);
  /// Ends a process as an operator does. Returns likewise.
  std::string stop(const Member& member);
  /// Ends all processes that publish detections, and the stranger. Returns the problems, in words.
  std::vector<std::string> stop_perceptions();
  /// Starts the processes again that have ended by themselves. Returns for each how it ended, with its last
  /// words.
  std::vector<std::string> restart_ended();

  /// Waits for a map at the planner, as wait_for_planner() does.
  bool planner_gets_maps(std::int64_t since_ns, std::chrono::milliseconds patience) const;

  /// The logs of all processes that published detections so far.
  std::vector<support::PublicationLog> publications() const;

 private:
  void start(const Member& member);
  std::vector<std::string> command_of(const Member& member);
  std::vector<std::string> perception(const std::filesystem::path& program);
  std::vector<std::string> stranger() const;
  const std::string& new_log();
  std::string output_of(const Member& member) const { return folder_.file(member.c_str()); }

  Spec spec_;
  io::WorkFolder folder_;
  std::vector<std::string> logs_;                                       ///< files of the publication logs
  std::map<Member, std::unique_ptr<support::ChildProcess>> processes_;  ///< the processes that should run
};

}  // namespace laneloom::endurance
