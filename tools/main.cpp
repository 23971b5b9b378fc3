#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "commands/commands.hpp"
#include "commands/exit_codes.hpp"
#include "commands/unknown_command.hpp"

namespace {

int run(int argc, char** argv) {
  CLI::App app("laneloom: drives, watches, draws and measures the lane map service", "laneloom");
  app.set_version_flag("--version", LANELOOM_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 1 it failed; 2 something wrong was found; 3 nobody was heard; 4 nothing to drive "
      "on; "
      "64 no such command, option or value.");
  laneloom::add_publish(app);
  laneloom::add_pnc(app);
  laneloom::add_status(app);
  laneloom::add_doctor(app);
  laneloom::add_render(app);
  laneloom::add_evaluate(app);
  laneloom::add_simulate(app);
  laneloom::add_calibrate(app);
  laneloom::add_experiment(app);
  laneloom::add_replay(app);
  laneloom::add_record(app);
  laneloom::add_import(app);
  laneloom::add_drive(app);
  laneloom::add_bench(app);
  laneloom::add_soak(app);
  const std::string complaint = laneloom::unknown_command(app, {argv + std::min(1, argc), argv + argc});
  if (!complaint.empty()) {
    std::fprintf(stderr, "laneloom: %s\n", complaint.c_str());
    return laneloom::kWrongUse;
  }
  try {
    app.parse(argc, argv);
    return laneloom::kDone;
  } catch (const CLI::RuntimeError& end) {  // of end_with()
    return end.get_exit_code();
  } catch (const CLI::Error& error) {  // or a call for help
    return app.exit(error) == 0 ? laneloom::kDone : laneloom::kWrongUse;
  }
}

/// Whether all that was printed has been taken; a full disk shows when it is flushed at the latest.
bool printed() { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

int run_and_tell(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "laneloom: %s\n", error.what());
    return laneloom::kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int code = run_and_tell(argc, argv);
  if (printed()) return code;
  std::fprintf(stderr, "laneloom: standard output cannot be written\n");
  return code == laneloom::kDone ? laneloom::kFailed : code;
}
