#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "commands/commands.hpp"

namespace {

int run(int argc, char** argv) {
  CLI::App app("laneloom: drives, watches, draws and measures the lane map service", "laneloom");
  app.set_version_flag("--version", LANELOOM_VERSION);
  app.require_subcommand(1);
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
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Error& error) {
    return app.exit(error);
  }
}

/// Whether all that was printed has been taken; a full disk shows when it is flushed at the latest.
bool printed() { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

int run_and_tell(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "laneloom: %s\n", error.what());
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int code = run_and_tell(argc, argv);
  if (printed()) return code;
  std::fprintf(stderr, "laneloom: standard output cannot be written\n");
  return code == 0 ? 1 : code;
}
