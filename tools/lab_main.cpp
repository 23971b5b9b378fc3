#include "commands/lab_commands.hpp"
#include "commands/program.hpp"

int main(int argc, char** argv) {
  using namespace laneloom::commands;
  return run_program({.name = "laneloom-lab",
                      .description = "laneloom-lab: measures laneloom on simulated drives and under faults",
                      .commands = {add_experiment, add_calibrate, add_drive, add_bench, add_soak},
                      .other = "laneloom",
                      .other_commands = {"publish", "pnc", "status", "doctor", "record", "replay", "import",
                                         "export", "view", "render", "evaluate", "simulate"}},
                     argc, argv);
}
