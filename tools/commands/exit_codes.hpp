#pragma once

#include <CLI/CLI.hpp>

namespace laneloom::commands {

/// The exit codes of all commands of `laneloom`. tools/README.md has the same table.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,            ///< the command could not do its work: a file, DDS, memory
  kFoundWrong = 2,        ///< the command did its work, and found something wrong
  kNobodyHeard = 3,       ///< no service, or no map of one
  kNothingToDriveOn = 4,  ///< maps without lanes, or a service that is STALE
  kWrongUse = 64,         ///< no such command, option or value; EX_USAGE of sysexits.h
};

/// Ends the command, which must have printed the reason.
[[noreturn]] inline void end_with(ExitCode code) { throw CLI::RuntimeError(code); }

}  // namespace laneloom::commands
