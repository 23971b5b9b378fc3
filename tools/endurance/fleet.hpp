#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/child_process.hpp"
#include "endurance/planner_output.hpp"
#include "io/work_folder.hpp"
#include "laneloom/config.hpp"
#include "support/publication_log.hpp"

namespace laneloom {

/// A publisher, a service and a planner of one vehicle, and more perceptions, as processes; each start of one
/// is a session of its own.
class Fleet {
 public:
  struct Spec {
    std::filesystem::path service;  ///< laneloomd
    std::filesystem::path command;  ///< laneloom
    DdsConfig dds;
    std::string scenario = "town";
    std::string noise = "inhouse";
    /// More perceptions, of whatever vendor: each is run as PROGRAM DOMAIN VEHICLE_ID FILE, gives its frames
    /// the stamps of poses and the program's name as their source, and writes to FILE what a
    /// PublicationLogWriter does.
    std::vector<std::filesystem::path> perceptions;
  };
  /// Starts all of them. Throws std::runtime_error where one cannot be started.
  explicit Fleet(Spec spec);

  /// A process by its name: one of these three, or that of a perception's program.
  using Member = std::string;
  static constexpr const char* kPublisher = "publisher";
  static constexpr const char* kService = "service";
  static constexpr const char* kPlanner = "planner";
  std::vector<Member> members() const;
  void signal(const Member& member, int number);
  /// Ends it at once, as a crash does, and starts it again.
  void kill_and_restart(const Member& member);
  /// Ends it as an operator does, and starts it again. Returns what was wrong with its end, in words.
  std::string restart(const Member& member);
  /// Ends it as an operator does. Returns likewise.
  std::string stop(const Member& member);
  /// Ends all who publish detections. Returns likewise, of each.
  std::vector<std::string> stop_perceptions();
  /// Those that have ended without being told to; they are started again.
  std::vector<Member> restart_ended();

  /// Waits for a map at the planner, as wait_for_planner() does.
  bool planner_gets_maps(std::int64_t since_ns, std::chrono::milliseconds patience) const;

  /// What all who published detections so far wrote down of themselves.
  std::vector<PublicationLog> publications() const;

 private:
  void start(const Member& member);
  std::vector<std::string> command_of(const Member& member);
  std::vector<std::string> perception(const std::filesystem::path& program);
  const std::string& new_log();
  std::string output_of(const Member& member) const { return folder_.file(member.c_str()); }

  Spec spec_;
  WorkFolder folder_;
  std::vector<std::string> logs_;                              ///< of those who publish, a file each
  std::map<Member, std::unique_ptr<ChildProcess>> processes_;  ///< those that are to run
};

}  // namespace laneloom
